// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Fonts.h"

#include "editor/Tokens.h"

#if __has_include(<FontData.h>)
#include <FontData.h>
#define PACINI_EMBEDDED_FONT 1
#else
#define PACINI_EMBEDDED_FONT 0
#endif

namespace pacini::editor
{

namespace
{
const juce::String fallbackName("Pacini fallback"); // asked for by JUCE where the family lacks a character

/// A font of Japanese that JUCE finds by name, or, on Linux, one in a collection, which it does not list.
struct JapaneseFont
{
    juce::String name;
    juce::Typeface::Ptr plain, bold;
    [[nodiscard]] bool isThere() const { return name.isNotEmpty() || plain != nullptr; }
};

juce::Typeface::Ptr collection(const juce::String& file)
{
    juce::MemoryBlock bytes;
    if (!juce::File(file).loadFileAsData(bytes))
        return nullptr;
    return juce::Typeface::createSystemTypefaceFor(bytes.getData(), bytes.getSize());
}

const JapaneseFont& japaneseFont()
{
    static const JapaneseFont found = []
    {
        JapaneseFont font;
        const auto names = juce::Font::findAllTypefaceNames();
        for (const char* name :
             {"Noto Sans CJK JP", "Noto Sans JP", "Source Han Sans JP", "Hiragino Sans", "Yu Gothic UI", "Meiryo",
              "IPAexGothic", "IPAPGothic", "IPAGothic", "TakaoPGothic", "VL PGothic"})
            if (names.contains(name))
            {
                font.name = name;
                return font;
            }
#if JUCE_LINUX || JUCE_BSD
        const juce::String folder = "/usr/share/fonts/opentype/noto/NotoSansCJK-";
        font.plain = collection(folder + "Regular.ttc");
        if (font.plain != nullptr)
            font.bold = collection(folder + "Bold.ttc");
#endif
        return font;
    }();
    return found;
}

/// The font of JUCE's components is that of the default look, which every font without a name of its own asks for.
class FontSource final : public juce::LookAndFeel_V4, private juce::DeletedAtShutdown
{
public:
    FontSource()
    {
#if PACINI_EMBEDDED_FONT
        plain = juce::Typeface::createSystemTypefaceFor(fontData::RobotoRegular_ttf, fontData::RobotoRegular_ttfSize);
        bold = juce::Typeface::createSystemTypefaceFor(fontData::RobotoMedium_ttf, fontData::RobotoMedium_ttfSize);
#endif
        setDefaultLookAndFeel(this);
#if JUCE_MAJOR_VERSION < 8 // later versions ask the system by themselves
        juce::Font::setFallbackFontName(fallbackName);
#endif
        juce::Font::setDefaultMinimumHorizontalScaleFactor(1.0f); // text is cut with an ellipsis, never squeezed
        juce::Typeface::clearTypefaceCache();
    }
    ~FontSource() override
    {
        juce::Typeface::clearTypefaceCache();
        current = nullptr;
    }

    static FontSource& get()
    {
        if (current == nullptr)
            current = new FontSource; // JUCE deletes it
        return *current;
    }

    void setJapanese(bool wanted)
    {
        japanese = wanted;
        juce::Typeface::clearTypefaceCache();
    }

    juce::Typeface::Ptr getTypefaceForFont(const juce::Font& font) override
    {
        const juce::String name = font.getTypefaceName();
        const bool usual = name == juce::Font::getDefaultSansSerifFontName();
        if (name == fallbackName || (usual && japanese))
            return fallback(font);
        if (usual && plain != nullptr)
            return font.isBold() ? bold : plain;
        return juce::LookAndFeel_V4::getTypefaceForFont(font);
    }

private:
    static juce::Typeface::Ptr fallback(const juce::Font& font)
    {
        const JapaneseFont& found = japaneseFont();
        if (found.plain != nullptr)
            return font.isBold() && found.bold != nullptr ? found.bold : found.plain;
        juce::Font named(font);
        named.setTypefaceName(found.isThere() ? found.name : juce::String("DejaVu Sans"));
        return juce::Typeface::createSystemTypefaceFor(named);
    }

    static FontSource* current;
    juce::Typeface::Ptr plain, bold;
    bool japanese = false;
};

FontSource* FontSource::current = nullptr;

juce::Font fontOf(float height, int style = juce::Font::plain)
{
#if JUCE_MAJOR_VERSION >= 8
    return juce::Font(juce::FontOptions(height, style));
#else
    return juce::Font(height, style);
#endif
}
} // namespace

void installFonts()
{
    FontSource::get();
}

bool hasEmbeddedFont() noexcept
{
    return PACINI_EMBEDDED_FONT != 0;
}

namespace
{
std::optional<bool> assumedJapanese;
}

void assumeJapaneseFont(std::optional<bool> there)
{
    assumedJapanese = there;
}

bool findJapaneseFont()
{
    return assumedJapanese.value_or(japaneseFont().isThere());
}

void useFontOf(const juce::String& language)
{
    FontSource::get().setJapanese(language == "ja" && findJapaneseFont());
}

juce::Typeface::Ptr typefaceFor(const juce::Font& font)
{
    return FontSource::get().getTypefaceForFont(font);
}

juce::Font captionFont()
{
    return fontOf(type::caption);
}

juce::Font smallFont()
{
    return fontOf(type::note);
}

juce::Font usualFont()
{
    return fontOf(type::text);
}

juce::Font titleFont()
{
    return fontOf(type::title, juce::Font::bold);
}

juce::Font fittingFont(const juce::String& text, int width, std::initializer_list<juce::Font> fonts)
{
    for (const juce::Font& font : fonts)
        if (font.getStringWidth(text) <= width)
            return font;
    return *(fonts.end() - 1);
}

} // namespace pacini::editor
