// What is wrong in a glTF file and can be set right in one way only: noted while the file is checked, told once it has loaded.
// Changes nothing itself; what could be meant in two ways is refused and never comes here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace antumbra::scene {

class Repairs
{
public:
    /// `remedy` says what is done instead. The same remedy at another place is counted, not repeated.
    void note(std::string_view place, std::string_view remedy);

    /// A line a remedy: "accessors[5] and 3 more: bounds that are not those of the values are left aside".
    [[nodiscard]] std::vector<std::string> lines() const;

private:
    struct Repair
    {
        std::string place; // the first
        std::string remedy;
        size_t morePlaces = 0;
    };

    std::vector<Repair> repairs_;
};

} // namespace antumbra::scene
