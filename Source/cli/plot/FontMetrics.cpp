#include "cli/plot/FontMetrics.h"

#include "cli/plot/CairoHandles.h"

namespace pacini::plot
{

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

} // namespace pacini::plot
