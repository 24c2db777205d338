#include "scene/gltf_uri.h"

#include "scene/gltf_document.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace antumbra::scene {

namespace {

constexpr std::string_view kDataScheme = "data:";
constexpr uint8_t kNoDigit = 255;

constexpr std::array<uint8_t, 256> base64Digits()
{
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<uint8_t, 256> digits{};
    digits.fill(kNoDigit);
    for (size_t i = 0; i < kAlphabet.size(); ++i)
        digits[static_cast<uint8_t>(kAlphabet[i])] = static_cast<uint8_t>(i);
    return digits;
}

std::vector<std::byte> decodeBase64(std::string_view text)
{
    static constexpr std::array<uint8_t, 256> kDigits = base64Digits();
    require(text.size() % 4 == 0, "base64 data has {} characters, not a multiple of 4", text.size());
    const size_t padding = text.ends_with("==") ? 2 : text.ends_with("=") ? 1 : 0;
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3);
    uint32_t bits = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool isPadding = i >= text.size() - padding;
        const uint8_t digit = isPadding ? uint8_t{0} : kDigits[static_cast<uint8_t>(text[i])];
        require(digit != kNoDigit, "base64 data has a wrong character at {}", i);
        bits = bits << 6 | digit;
        if (i % 4 == 3)
            for (const int shift : {16, 8, 0})
                bytes.push_back(static_cast<std::byte>(bits >> shift & 0xff));
    }
    bytes.erase(bytes.end() - static_cast<std::ptrdiff_t>(padding), bytes.end());
    return bytes;
}

std::string decodePercent(std::string_view uri)
{
    std::string decoded;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            decoded += uri[i];
            continue;
        }
        const auto isHex = [&](size_t at) { return at < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[at])) != 0; };
        require(isHex(i + 1) && isHex(i + 2), "uri \"{}\" has a broken percent escape", uri);
        decoded += static_cast<char>(std::stoi(std::string(uri.substr(i + 1, 2)), nullptr, 16));
        i += 2;
    }
    return decoded;
}

bool hasScheme(std::string_view uri)
{
    const size_t colon = uri.find(':');
    return colon != std::string_view::npos && uri.find('/') > colon;
}

void checkRelative(std::string_view uri, const Path& path)
{
    const std::string& name = path.native();
    require(!name.empty(), "uri is empty");
    require(!hasScheme(uri), "uri \"{}\" has a scheme; only data: and relative files are read", uri);
    require(name.find('\\') == std::string::npos && std::none_of(name.begin(), name.end(), [](unsigned char c) { return c < ' '; }),
            "uri \"{}\" has a character that no path may have", uri);
    require(!path.is_absolute(), "uri \"{}\" is absolute", uri);
    require(std::find(path.begin(), path.end(), "..") == path.end(), "uri \"{}\" leaves the file's own folder", uri);
}

} // namespace

bool isDataUri(std::string_view uri) { return uri.starts_with(kDataScheme); }

DataUri decodeDataUri(std::string_view uri)
{
    constexpr std::string_view kEncoding = ";base64";
    const size_t comma = uri.find(',');
    require(comma != std::string_view::npos, "a data uri has no data");
    const std::string_view header = uri.substr(kDataScheme.size(), comma - kDataScheme.size());
    require(header.ends_with(kEncoding), "a data uri is not base64");
    return {std::string(header.substr(0, header.find(';'))), decodeBase64(uri.substr(comma + 1))};
}

std::vector<std::byte> readRelativeUri(const Path& folder, std::string_view uri, uint64_t greatestBytes)
{
    const Path path = decodePercent(uri);
    checkRelative(uri, path);
    std::error_code failure;
    const Path home = std::filesystem::canonical(folder, failure);
    const Path target = std::filesystem::canonical(home / path, failure);
    require(!failure, "uri \"{}\": no such file", uri);
    const auto [homeEnd, inside] = std::mismatch(home.begin(), home.end(), target.begin(), target.end());
    require(homeEnd == home.end(), "uri \"{}\" leads out of the file's own folder", uri);
    return readFile(target, greatestBytes);
}

} // namespace antumbra::scene
