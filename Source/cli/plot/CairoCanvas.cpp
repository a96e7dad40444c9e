#include "cli/plot/CairoCanvas.h"

#if PACINI_HAS_CAIRO

#include "cli/plot/CairoHandles.h"
#include "cli/plot/FontMetrics.h"

#include <cairo-pdf.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace pacini::plot
{

namespace
{
cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) noexcept
{
    try
    {
        static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
        return CAIRO_STATUS_SUCCESS;
    }
    catch (...)
    {
        return CAIRO_STATUS_NO_MEMORY;
    }
}

void setColour(cairo_t* context, const Colour& colour)
{
    cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.alpha);
}

} // namespace

struct CairoCanvas::State
{
    std::unique_ptr<std::string> bytes = std::make_unique<std::string>(); ///< a PDF, as it comes
    Surface surface;
    Context context;
    FontMetrics metrics;
    bool isPng = false;
};

std::unique_ptr<Canvas> CairoCanvas::png(int width, int height)
{
    auto state = std::make_unique<State>();
    state->isPng = true;
    state->surface.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
    state->context.reset(cairo_create(state->surface.get()));
    return std::unique_ptr<Canvas>(new CairoCanvas(std::move(state)));
}

std::unique_ptr<Canvas> CairoCanvas::pdf(int width, int height, const std::string& title)
{
    constexpr double pointsPerPixel = 0.75;
    auto state = std::make_unique<State>();
    state->surface.reset(cairo_pdf_surface_create_for_stream(append, state->bytes.get(), pointsPerPixel * width,
                                                             pointsPerPixel * height));
    cairo_pdf_surface_set_metadata(state->surface.get(), CAIRO_PDF_METADATA_TITLE, printable(title).c_str());
    state->context.reset(cairo_create(state->surface.get()));
    cairo_scale(state->context.get(), pointsPerPixel, pointsPerPixel);
    return std::unique_ptr<Canvas>(new CairoCanvas(std::move(state)));
}

CairoCanvas::CairoCanvas(std::unique_ptr<State> started) : state(std::move(started))
{
    useExactMetrics(state->context.get());
}

CairoCanvas::~CairoCanvas() = default;

void CairoCanvas::draw(const Path& path, const Paint& paint)
{
    cairo_t* context = state->context.get();
    cairo_new_path(context);
    for (const Path::Step& step : path.all())
        switch (step.verb)
        {
        case Path::Verb::move:
            cairo_move_to(context, step.to.x, step.to.y);
            break;
        case Path::Verb::line:
            cairo_line_to(context, step.to.x, step.to.y);
            break;
        case Path::Verb::close:
            cairo_close_path(context);
            break;
        }
    if (paint.fill)
    {
        setColour(context, *paint.fill);
        cairo_fill_preserve(context);
    }
    if (paint.stroke)
    {
        const Stroke& stroke = *paint.stroke;
        setColour(context, stroke.colour);
        cairo_set_line_width(context, stroke.width);
        cairo_set_line_cap(context, stroke.round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
        cairo_set_line_join(context, stroke.round ? CAIRO_LINE_JOIN_ROUND : CAIRO_LINE_JOIN_MITER);
        cairo_set_dash(context, &stroke.dash, stroke.dash > 0.0 ? 1 : 0, 0.0);
        cairo_stroke_preserve(context);
    }
    cairo_new_path(context);
}

void CairoCanvas::text(Point at, std::string_view what, const TextStyle& style)
{
    cairo_t* context = state->context.get();
    const double width = textWidth(what, style);
    cairo_save(context);
    cairo_translate(context, at.x, at.y);
    if (style.upwards)
        cairo_rotate(context, -std::numbers::pi / 2.0);
    cairo_move_to(context,
                  style.align == Align::left     ? 0.0
                  : style.align == Align::centre ? -0.5 * width
                                                 : -width,
                  0.0);
    setColour(context, style.colour);
    setFont(context, style);
    cairo_show_text(context, printable(what).c_str());
    cairo_restore(context);
}

double CairoCanvas::textWidth(std::string_view what, const TextStyle& style) const
{
    return state->metrics.textWidth(what, style);
}

void CairoCanvas::beginGroup(std::string_view, const std::optional<Rectangle>& clip)
{
    cairo_t* context = state->context.get();
    cairo_save(context);
    if (clip)
    {
        cairo_rectangle(context, clip->left, clip->top, clip->width(), clip->height());
        cairo_clip(context);
    }
}

void CairoCanvas::endGroup()
{
    cairo_restore(state->context.get());
}

Result<std::string> CairoCanvas::finish()
{
    cairo_status_t status = cairo_status(state->context.get());
    state->context.reset();
    if (status == CAIRO_STATUS_SUCCESS && state->isPng)
        status = cairo_surface_write_to_png_stream(state->surface.get(), append, state->bytes.get());
    cairo_surface_finish(state->surface.get());
    if (status == CAIRO_STATUS_SUCCESS)
        status = cairo_surface_status(state->surface.get());
    if (status == CAIRO_STATUS_NO_MEMORY || status == CAIRO_STATUS_INVALID_SIZE)
        return Error{ErrorCode::tooLarge, "", "is too large a picture for the memory; choose a smaller size"};
    if (status != CAIRO_STATUS_SUCCESS)
        return Error{ErrorCode::io, "", std::string("cannot be drawn: ") + cairo_status_to_string(status)};
    return std::move(*state->bytes);
}

} // namespace pacini::plot

#endif
