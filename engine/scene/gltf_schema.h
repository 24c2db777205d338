// A small language for what a JSON object may contain: every property's type, range, and the array that an index points into.
// Judges the JSON tree alone; what takes binary data or several objects to judge is the business of gltf_rules.h.
#pragma once

#include "scene/gltf_document.h"

#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

namespace antumbra::scene {

struct Property;
/// The known properties of an object. Unknown ones are allowed and ignored, as glTF asks.
using Shape = std::span<const Property>;

/// What one property must be. Lists of words are separated by single spaces.
struct Rule
{
    enum class Type { Boolean, Integer, Number, Text, Object };
    enum class Container { None, Array, Map, ArrayOfMaps };

    Type type = Type::Boolean;
    Container container = Container::None;
    size_t fewest = 1; // elements of the container
    size_t most = std::numeric_limits<size_t>::max();
    bool isRequired = false;
    bool isDistinct = false;    // no element twice
    bool excludesLeast = false; // greater than `least`, not equal
    double least = std::numeric_limits<float>::lowest();
    double greatest = std::numeric_limits<float>::max();
    std::string_view words{};      // the values allowed
    std::string_view pointsInto{}; // Integer: an index into the array at this JSON pointer
    std::string_view selects{};    // a value among these demands the sibling of that name
    std::string_view needs{};      // a sibling that must be there too
    std::string_view excludes{};   // siblings that must not
    Shape shape{};                 // Object

    // Before its uses: in constant expressions clang 14 knows no template that is defined later.
    template <class T>
    constexpr Rule with(T Rule::*member, std::type_identity_t<T> value) const
    {
        Rule changed = *this;
        changed.*member = value;
        return changed;
    }

    constexpr Rule required() const { return with(&Rule::isRequired, true); }
    constexpr Rule distinct() const { return with(&Rule::isDistinct, true); }
    constexpr Rule from(double value) const { return with(&Rule::least, value); }
    constexpr Rule above(double value) const { return from(value).with(&Rule::excludesLeast, true); }
    constexpr Rule upTo(double value) const { return with(&Rule::greatest, value); }
    constexpr Rule among(std::string_view list) const { return with(&Rule::words, list); }
    constexpr Rule selecting(std::string_view list) const { return with(&Rule::selects, list); }
    constexpr Rule needing(std::string_view sibling) const { return with(&Rule::needs, sibling); }
    constexpr Rule excluding(std::string_view list) const { return with(&Rule::excludes, list); }
};

struct Property
{
    std::string_view name;
    Rule rule;
};

/// An extension's object, known where it may stand: in objects of shape `place`.
struct Extension
{
    std::string_view name;
    Shape place;
    Shape shape;
};

inline constexpr double kGreatestInteger = 9007199254740992.0; // 2^53: exact in a double, and far from overflow in sums

constexpr Rule boolean() { return {}; }
constexpr Rule integer() { return Rule{.type = Rule::Type::Integer}.from(-kGreatestInteger).upTo(kGreatestInteger); }
constexpr Rule number() { return {.type = Rule::Type::Number}; }
constexpr Rule text() { return {.type = Rule::Type::Text}; }
constexpr Rule object(Shape shape) { return {.type = Rule::Type::Object, .shape = shape}; }
constexpr Rule indexInto(std::string_view array) { return integer().from(0).with(&Rule::pointsInto, array); }

constexpr Rule arrayOf(Rule element, size_t fewest = 1, size_t most = std::numeric_limits<size_t>::max())
{
    return element.with(&Rule::container, Rule::Container::Array).with(&Rule::fewest, fewest).with(&Rule::most, most);
}
constexpr Rule mapOf(Rule element) { return element.with(&Rule::container, Rule::Container::Map); }
constexpr Rule arrayOfMapsOf(Rule element) { return element.with(&Rule::container, Rule::Container::ArrayOfMaps); }

/// Throws Error{place and complaint} for the first property that breaks its rule. Integers written as floats become integers.
void checkShape(Json& root, Shape shape, std::span<const Extension> extensions);

/// glTF 2.0 and the extensions whose content this loader reads or checks.
void checkGltfSchema(Json& root);

} // namespace antumbra::scene
