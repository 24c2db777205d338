#include "ecs/component_store.h"

namespace antumbra::ecs {

constinit EntitySet::Page EntitySet::kEmptyPage = [] {
    Page page{};
    page.fill(kAbsent);
    return page;
}();

void EntitySet::makePage(uint32_t page)
{
    if (page >= pages_.size())
        pages_.resize(page + 1, &kEmptyPage);
    ownedPages_.push_back(std::make_unique<Page>(kEmptyPage));
    pages_[page] = ownedPages_.back().get();
}

} // namespace antumbra::ecs
