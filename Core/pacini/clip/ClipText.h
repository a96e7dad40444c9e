#pragma once

// Text model of packed clips: the words of a clip (its name, its source, the parameters of its encoder) as text that
// packs well.

#include <pacini/clip/Clip.h>
#include <pacini/clip/PackedText.h>
#include <pacini/foundation/NumberText.h>
#include <pacini/foundation/ParseNumber.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace pacini::detail
{

/// Text similar to that of clips, for the predictor. Part of the format: changing it changes the version.
inline std::string textPrimer()
{
    std::string text;
    for (const char* name : {"Metal Impact 01.wav", "knock_wood_door.wav", "footsteps-gravel_2.flac", "engine.ogg",
                             "music_loop_128.aiff", "ambience 60s.mp3", "Explosion-long.wav", "click.wav"})
        text += std::string(name) + '\0';
    for (const char* gain : {"0.5", "1.25", "2.375"})
        text += std::string("smethod=a2vt\nsversion=0.1.0\nnbands=12\nnbreakpoints=12\nnquantise=6\nngain=") + gain +
                "\n" + '\0';
    return text;
}

/// A coder that has read the primer, which takes longer than coding the words of a clip: once is enough.
inline TextCoder clipTextCoder()
{
    static const TextCoder primed(textPrimer());
    return primed;
}

/// Characters that mean something in the coded text ('=' and the ends of texts and lines) travel behind a 1.
inline std::string escaped(std::string_view text)
{
    std::string result;
    for (char c : text)
        if (c == '\0' || c == '\1' || c == '\n' || c == '=')
        {
            result += '\1';
            result += static_cast<char>(c + 2);
        }
        else
            result += c;
    return result;
}

inline std::string unescaped(std::string_view text)
{
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '\1' && i + 1 < text.size())
            result += static_cast<char>(text[++i] - 2);
        else
            result += text[i];
    return result;
}

inline std::string fileStem(const std::string& file)
{
    const auto dot = file.rfind('.');
    return dot == std::string::npos || dot == 0 ? file : file.substr(0, dot);
}

/// Parameters as text, one line for each: a letter for its type, the name, '=', the value.
inline std::string parameterText(const std::vector<EncoderParameter>& parameters)
{
    std::string text;
    for (const EncoderParameter& parameter : parameters)
    {
        const std::string name = escaped(parameter.name);
        if (const auto* number = std::get_if<double>(&parameter.value))
            text += "n" + name + "=" + numberText(*number);
        else if (const auto* words = std::get_if<std::string>(&parameter.value))
            text += "s" + name + "=" + escaped(*words);
        else
            text += "b" + name + "=" + (std::get<bool>(parameter.value) ? "1" : "0");
        text += "\n";
    }
    return text;
}

inline std::vector<EncoderParameter> parametersOf(const std::string& text)
{
    std::vector<EncoderParameter> parameters;
    for (std::size_t at = 0; at < text.size();)
    {
        const auto end = std::min(text.find('\n', at), text.size());
        const std::string_view line(text.data() + at, end - at);
        at = end + 1;
        const auto equals = line.find('=');
        if (equals == std::string_view::npos || equals < 1)
            continue;
        EncoderParameter parameter{unescaped(line.substr(1, equals - 1)), {}};
        const std::string_view value = line.substr(equals + 1);
        if (line[0] == 'n')
            parameter.value = parseNumber(value).value_or(0.0);
        else if (line[0] == 'b')
            parameter.value = value == "1";
        else
            parameter.value = unescaped(value);
        parameters.push_back(std::move(parameter));
    }
    return parameters;
}

/// Codes the texts of a clip both ways, as ClipCoder does with the rest.
template <typename Coder>
class ClipTexts
{
public:
    explicit ClipTexts(Coder& coderToUse) : coder(coderToUse) {}

    /// Name, source and parameters.
    void codeClip(Clip& clip)
    {
        clip.source.file = code(clip.source.file);
        if (coder.bit(clip.name == fileStem(clip.source.file), namedAfterFileModel))
            clip.name = fileStem(clip.source.file);
        else
            clip.name = code(clip.name);

        if constexpr (!Coder::reading)
            codeRaw(parameterText(clip.encoder));
        else
            clip.encoder = parametersOf(codeRaw({}));
    }

    std::string code(const std::string& words) { return unescaped(codeRaw(escaped(words))); }

private:
    std::string codeRaw(const std::string& words)
    {
        std::string result = text.code(coder, words, left);
        left -= std::min(left, result.size());
        return result;
    }

    Coder& coder;
    TextCoder text = clipTextCoder();
    std::size_t left = 2 * limits::text; // escaping can double a text
    AdaptiveBit namedAfterFileModel{0.9, 2};
};

} // namespace pacini::detail
