#include "scene/gltf_schema.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace antumbra::scene {

namespace {

template <class Visit>
void forEachWord(std::string_view list, Visit visit)
{
    while (!list.empty()) {
        const size_t end = std::min(list.find(' '), list.size());
        visit(list.substr(0, end));
        list.remove_prefix(std::min(end + 1, list.size()));
    }
}

bool contains(std::string_view list, std::string_view word)
{
    bool found = false;
    forEachWord(list, [&](std::string_view entry) { found |= entry == word; });
    return found;
}

std::string wordOf(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// Walks the tree and the tables side by side; `where_` is the path to the value in hand.
class SchemaCheck
{
public:
    SchemaCheck(const Json& root, std::span<const Extension> extensions) : root_(root), extensions_(extensions) {}

    void checkObject(Json& object, Shape shape)
    {
        expect(object.is_object(), "must be an object");
        for (const Property& property : shape) {
            const auto found = object.find(property.name);
            const Step step(*this, property.name);
            expect(found != object.end() || !property.rule.isRequired, "is missing");
            if (found == object.end())
                continue;
            checkSiblings(object, *found, property.rule);
            checkProperty(*found, property.rule);
        }
        checkName(object);
        checkExtensions(object, shape);
    }

private:
    /// Lengthens the path while a property is in hand.
    class Step
    {
    public:
        Step(SchemaCheck& check, std::string_view name) : check_(check), length_(check.where_.size())
        {
            check.where_.append(length_ == 0 ? "" : ".").append(name);
        }
        Step(SchemaCheck& check, size_t index) : check_(check), length_(check.where_.size())
        {
            check.where_.append("[").append(std::to_string(index)).append("]");
        }
        ~Step() { check_.where_.resize(length_); }
        Step(const Step&) = delete;
        Step& operator=(const Step&) = delete;

    private:
        SchemaCheck& check_;
        size_t length_;
    };

    void expect(bool holds, std::string_view complaint) const
    {
        require(holds, "{} {}", where_.empty() ? std::string_view("the document") : std::string_view(where_), complaint);
    }

    void checkSiblings(const Json& object, const Json& value, const Rule& rule) const
    {
        if (!rule.needs.empty() && !object.contains(rule.needs))
            expect(false, fmt::format("needs {} beside it", rule.needs));
        forEachWord(rule.excludes, [&](std::string_view sibling) {
            if (object.contains(sibling))
                expect(false, fmt::format("excludes {} beside it", sibling));
        });
        if (value.is_string() && contains(rule.selects, value.get<std::string>()) && !object.contains(value.get<std::string>()))
            expect(false, fmt::format("is \"{}\" and needs the property of that name", value.get<std::string>()));
    }

    void checkProperty(Json& value, const Rule& rule)
    {
        switch (rule.container) {
        case Rule::Container::None: checkValue(value, rule); break;
        case Rule::Container::Array: checkArray(value, rule, &SchemaCheck::checkValue); break;
        case Rule::Container::Map: checkMap(value, rule); break;
        case Rule::Container::ArrayOfMaps: checkArray(value, rule, &SchemaCheck::checkMap); break;
        }
    }

    void checkArray(Json& array, const Rule& rule, void (SchemaCheck::*checkElement)(Json&, const Rule&))
    {
        expect(array.is_array(), "must be an array");
        checkCount(array, rule);
        for (size_t i = 0; i < array.size(); ++i) {
            const Step step(*this, i);
            (this->*checkElement)(array[i], rule);
        }
    }

    void checkMap(Json& map, const Rule& rule)
    {
        expect(map.is_object(), "must be an object");
        checkCount(map, rule);
        for (auto entry = map.begin(); entry != map.end(); ++entry) {
            const Step step(*this, entry.key());
            checkValue(entry.value(), rule);
        }
    }

    void checkCount(const Json& container, const Rule& rule) const
    {
        expect(container.size() >= rule.fewest, rule.fewest == 1 ? "must not be empty" : "has too few elements");
        expect(container.size() <= rule.most, "has too many elements");
        if (!rule.isDistinct)
            return;
        std::unordered_set<std::string> seen;
        for (const Json& element : container)
            expect(seen.insert(element.dump()).second, "has an element twice");
    }

    void checkValue(Json& value, const Rule& rule)
    {
        switch (rule.type) {
        case Rule::Type::Boolean: expect(value.is_boolean(), "must be true or false"); break;
        case Rule::Type::Integer:
            expect(value.is_number() && std::trunc(value.get<double>()) == value.get<double>(), "must be an integer");
            checkRange(value, rule);
            if (value.is_number_float())
                value = static_cast<int64_t>(value.get<double>());
            break;
        case Rule::Type::Number:
            expect(value.is_number(), "must be a number");
            checkRange(value, rule);
            break;
        case Rule::Type::Text: expect(value.is_string(), "must be a text"); break;
        case Rule::Type::Object: checkObject(value, rule.shape); break;
        }
        if (!rule.words.empty() && !contains(rule.words, wordOf(value)))
            expect(false, fmt::format("is {}, which is none of: {}", wordOf(value), rule.words));
    }

    void checkRange(const Json& value, const Rule& rule)
    {
        const double number = value.get<double>();
        const bool isInside = number <= rule.greatest && (rule.excludesLeast ? number > rule.least : number >= rule.least);
        if (!isInside)
            expect(false, fmt::format("is {}, out of range", value.dump()));
        if (!rule.pointsInto.empty() && number >= static_cast<double>(sizeOf(rule.pointsInto)))
            expect(false, fmt::format("is {}, but {} has {} elements", value.dump(), rule.pointsInto, sizeOf(rule.pointsInto)));
    }

    void checkName(const Json& object)
    {
        const auto name = object.find("name");
        const Step step(*this, "name");
        expect(name == object.end() || name->is_string(), "must be a text");
    }

    void checkExtensions(Json& object, Shape place)
    {
        const auto found = object.find("extensions");
        if (found == object.end())
            return;
        const Step extensions(*this, "extensions");
        expect(found->is_object(), "must be an object");
        for (auto entry = found->begin(); entry != found->end(); ++entry) {
            const Step step(*this, entry.key());
            checkExtension(entry.key(), entry.value(), place);
        }
    }

    void checkExtension(std::string_view name, Json& value, Shape place)
    {
        expect(value.is_object(), "must be an object");
        const auto isNamed = [name](const Extension& extension) { return extension.name == name; };
        if (std::none_of(extensions_.begin(), extensions_.end(), isNamed))
            return;
        const auto known = std::find_if(extensions_.begin(), extensions_.end(), [&](const Extension& extension) {
            return isNamed(extension) && extension.place.data() == place.data();
        });
        expect(known != extensions_.end(), "does not belong here");
        checkObject(value, known->shape);
    }

    size_t sizeOf(std::string_view pointer)
    {
        const auto [entry, isNew] = sizes_.try_emplace(pointer, 0);
        const Json::json_pointer place{std::string(pointer)};
        if (isNew && root_.contains(place) && root_[place].is_array())
            entry->second = root_[place].size();
        return entry->second;
    }

    const Json& root_;
    std::span<const Extension> extensions_;
    std::string where_;
    std::unordered_map<std::string_view, size_t> sizes_;
};

} // namespace

void checkShape(Json& root, Shape shape, std::span<const Extension> extensions) { SchemaCheck(root, extensions).checkObject(root, shape); }

} // namespace antumbra::scene
