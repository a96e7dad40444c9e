// Colours of the windows: texts can be read, and what differs in colour differs for everybody.

#include "editor/Theme.h"
#include "support/Catch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

using namespace pacini;

namespace
{
using Linear = std::array<double, 3>;

Linear linearOf(juce::Colour colour)
{
    const auto decode = [](double v)
    {
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return {decode(colour.getFloatRed()), decode(colour.getFloatGreen()), decode(colour.getFloatBlue())};
}

double luminance(const Linear& c)
{
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

/// WCAG 2.2, "contrast ratio".
double contrast(juce::Colour a, juce::Colour b)
{
    const double x = luminance(linearOf(a)), y = luminance(linearOf(b));
    return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

/// What somebody sees without one kind of cone: F. Viénot, H. Brettel, J. Mollon, "Digital video colourmaps for
/// checking the legibility of displays by dichromats", Color Research & Application, 1999, in linear RGB.
Linear protanopia(const Linear& c)
{
    const double mixed = 0.11238 * c[0] + 0.88762 * c[1];
    return {mixed, mixed, 0.00401 * c[0] - 0.00401 * c[1] + c[2]};
}

Linear deuteranopia(const Linear& c)
{
    const double mixed = 0.29275 * c[0] + 0.70725 * c[1];
    return {mixed, mixed, -0.02234 * c[0] + 0.02234 * c[1] + c[2]};
}

/// Distance in CIELAB (1976) with D65; 2.3 is just noticed side by side.
double distance(const Linear& a, const Linear& b)
{
    const auto lab = [](const Linear& c)
    {
        const auto f = [](double t)
        {
            return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0;
        };
        const double x = f((0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2]) / 0.9505);
        const double y = f(luminance(c));
        const double z = f((0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2]) / 1.089);
        return Linear{116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
    };
    const Linear p = lab(a), q = lab(b);
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}
} // namespace

TEST_CASE("Texts have the contrast that readers with weak eyes need, light and dark")
{
    for (const bool dark : {true, false})
    {
        CAPTURE(dark);
        const auto& p = editor::paletteOf(dark);
        for (const juce::Colour ground : {p.background, p.card, p.well, p.control})
        {
            CHECK(contrast(p.text, ground) >= 7.0); // WCAG AAA
            CHECK(contrast(p.dim, ground) >= 4.5);  // AA
            for (const juce::Colour mark : {p.accent, p.warning, p.danger, p.event, p.tone, p.primary})
                CHECK(contrast(mark, ground) >= 3.0);
        }
        CHECK(contrast(p.onAccent, p.accent) >= 4.5);
        CHECK(contrast(p.onPrimary, p.primary) >= 7.0);
    }
}

TEST_CASE("Accent, warning, events and text are told apart without red or green cones")
{
    for (const bool dark : {true, false})
    {
        const auto& p = editor::paletteOf(dark);
        const std::array<std::pair<juce::Colour, juce::Colour>, 7> pairs{{{p.accent, p.warning},
                                                                          {p.accent, p.text},
                                                                          {p.warning, p.text},
                                                                          {p.event, p.accent},
                                                                          {p.event, p.warning},
                                                                          {p.event, p.danger},
                                                                          {p.event, p.text}}};
        for (const auto& [one, other] : pairs)
        {
            CAPTURE(dark, one.toString(), other.toString());
            const Linear a = linearOf(one), b = linearOf(other);
            CHECK(distance(a, b) > 20.0);
            CHECK(distance(protanopia(a), protanopia(b)) > 15.0);
            CHECK(distance(deuteranopia(a), deuteranopia(b)) > 15.0);
        }
    }
}
