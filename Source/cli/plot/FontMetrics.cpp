#include "cli/plot/FontMetrics.h"

#if PACINI_HAS_CAIRO
#include "cli/plot/CairoHandles.h"
#endif

namespace pacini::plot
{

#if PACINI_HAS_CAIRO

struct FontMetrics::State
{
    Surface surface{cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1)};
    Context context{cairo_create(surface.get())};
};

FontMetrics::FontMetrics() : state(std::make_unique<State>())
{
    useExactMetrics(state->context.get());
}

FontMetrics::~FontMetrics() = default;

double FontMetrics::textWidth(std::string_view what, const TextStyle& style) const
{
    cairo_t* context = state->context.get();
    setFont(context, style);
    cairo_text_extents_t extents;
    cairo_text_extents(context, printable(what).c_str(), &extents);
    return extents.x_advance;
}

#else

struct FontMetrics::State
{
};

FontMetrics::FontMetrics() = default;
FontMetrics::~FontMetrics() = default;

double FontMetrics::textWidth(std::string_view what, const TextStyle& style) const
{
    double width = 0.0; // of the size: about those of DejaVu Sans, whose digits have 0.64
    for (const char letter : printable(what))
        if ((static_cast<unsigned char>(letter) & 0xc0U) != 0x80U) // not a further byte of UTF-8
            width += std::string_view(" .,:;'|!()[]/ijlt").find(letter) != std::string_view::npos ? 0.36 : 0.64;
    return width * style.size * (style.bold ? 1.1 : 1.0);
}

#endif

} // namespace pacini::plot
