#pragma once

// Warnings of the readers of clips, scenes and profiles, such as unknown keys.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// Warnings with their places. Of a text that has very many the first are kept and the others counted.
class ReadWarnings
{
public:
    static constexpr std::size_t maxKept = 20;

    ReadWarnings() = default;
    explicit ReadWarnings(bool beStrict) : strict(beStrict) {}

    /// Whether warnings are errors, at which the reader stops.
    [[nodiscard]] bool isStrict() const noexcept { return strict; }

    /// Whether one more is kept; else count() is enough.
    [[nodiscard]] bool hasRoom() const noexcept { return kept.size() < maxKept; }

    void add(std::string_view where, std::string_view message);
    void count() noexcept { ++notKept; }

    /// Returns each warning as `plays[2].gian: is not known; did you mean "gain"?`, and the number of further ones.
    [[nodiscard]] std::vector<std::string> texts() const;

private:
    std::vector<std::string> kept;
    std::size_t notKept = 0;
    bool strict = false;
};

/// The one of `known` that `given` is meant to be: another word for it (`speed` for `stretch`), or a slip of the
/// pen away; empty when there is none.
[[nodiscard]] std::string_view nearestKey(std::string_view given, const std::vector<std::string_view>& known);

/// Whether a key is meant for people or other programs: `$schema`, `_comment`, `//`. Such keys cause no warnings.
[[nodiscard]] bool isRemark(std::string_view key) noexcept;

/// Returns the warning for a key that is not one of `known`, with the nearest one.
[[nodiscard]] std::string unknownKeyText(std::string_view given, const std::vector<std::string_view>& known);

} // namespace pacini
