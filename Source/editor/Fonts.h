// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The type family of all windows, in four sizes, and the fonts behind it.

#include <juce_gui_basics/juce_gui_basics.h>

#include <initializer_list>
#include <optional>

namespace pacini::editor
{

/// Sets up the fonts of all components: the embedded family, or the system's where none is embedded; what it lacks
/// (Japanese, arrows) comes from an installed font. Repeated calls do nothing. [message]
void installFonts();

/// Whether the family is compiled in, so that windows look alike on every machine.
[[nodiscard]] bool hasEmbeddedFont() noexcept;

/// Whether this system has a font with the characters of Japanese.
[[nodiscard]] bool findJapaneseFont();

/// For tests: whether there is one, whatever is installed; as it is from nothing on. [message]
void assumeJapaneseFont(std::optional<bool> there);

/// Fonts from now on suit this language: Japanese is set in its own font as a whole. [message]
void useFontOf(const juce::String& language);

/// The typeface of a font in the looks of windows. [message]
[[nodiscard]] juce::Typeface::Ptr typefaceFor(const juce::Font& font);

/// Sizes of type, see Tokens.h. All figures are equally wide, so that numbers do not jitter.
[[nodiscard]] juce::Font captionFont();
[[nodiscard]] juce::Font smallFont();
[[nodiscard]] juce::Font usualFont();
[[nodiscard]] juce::Font titleFont();

/// The first of some fonts, the largest first, in which a text is no wider than that; the last where none is.
[[nodiscard]] juce::Font fittingFont(const juce::String& text, int width, std::initializer_list<juce::Font> fonts);

} // namespace pacini::editor
