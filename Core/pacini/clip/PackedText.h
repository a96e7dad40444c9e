#pragma once

// Compression of short texts: names and parameters in a few bytes.

#include <pacini/clip/RangeCoder.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// Codes short texts by prediction from the characters before (Cleary and Witten, "Data compression using adaptive
/// coding and partial string matching", 1984, reduced to two orders). Both sides first read `primer`, text of the kind
/// that is to come, so that what looks like it costs almost nothing. Texts end with a zero byte, which they therefore
/// cannot contain.
class TextCoder
{
public:
    explicit TextCoder(std::string_view primer) : models(slots)
    {
        Learner learner;
        for (char c : primer)
            codeByte(learner, static_cast<std::uint8_t>(c));
    }

    /// Writes `text` up to its first zero byte, or ignores it and reads at most `most` characters.
    template <typename Coder>
    std::string code(Coder& coder, std::string_view text, std::size_t most)
    {
        std::string result;
        for (std::size_t i = 0; i <= most; ++i)
        {
            const auto wanted = i < text.size() ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{0};
            const std::uint8_t got = codeByte(coder, i < most ? wanted : std::uint8_t{0});
            if (got == 0 || i == most)
                break;
            result.push_back(static_cast<char>(got));
        }
        return result;
    }

private:
    static constexpr std::size_t slots = std::size_t{1} << 15;

    /// A coder that writes nothing: only the models learn.
    struct Learner
    {
        bool bit(bool b, AdaptiveBit& model)
        {
            model.update(b);
            return b;
        }
    };

    struct Model
    {
        AdaptiveBit bit;
        std::uint8_t seen = 0;
    };

    template <typename Coder>
    std::uint8_t codeByte(Coder& coder, std::uint8_t wanted)
    {
        std::uint32_t node = 1;
        for (int i = 7; i >= 0; --i)
        {
            // The longest context that has been met decides; all of them learn.
            std::array<Model*, 3> found = {
                &slot(0x10000u, node), &slot(0x20000u | history[0], node),
                &slot(0x30000u | history[0] | (static_cast<std::uint32_t>(history[1]) << 8), node)};
            std::size_t use = 2;
            while (use > 0 && found[use]->seen == 0)
                --use;
            const bool bit = coder.bit(((wanted >> i) & 1) != 0, found[use]->bit);
            for (std::size_t k = 0; k < found.size(); ++k)
            {
                if (k != use)
                    found[k]->bit.update(bit);
                found[k]->seen = 1;
            }
            node = (node << 1) | static_cast<std::uint32_t>(bit);
        }
        const auto byte = static_cast<std::uint8_t>(node & 0xFFu);
        history[1] = history[0];
        history[0] = byte;
        return byte;
    }

    Model& slot(std::uint32_t context, std::uint32_t node)
    {
        const std::uint32_t hash = (context * 0x9E3779B1u) ^ (node * 0x85EBCA6Bu);
        return models[(hash ^ (hash >> 15)) & (slots - 1)];
    }

    std::vector<Model> models;
    std::array<std::uint8_t, 2> history{};
};

} // namespace pacini
