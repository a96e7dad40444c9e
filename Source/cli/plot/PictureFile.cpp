#include "cli/plot/PictureFile.h"

#include "cli/InputFiles.h"
#include "cli/plot/CairoCanvas.h"
#include "cli/plot/SvgCanvas.h"
#include "io/AtomicFile.h"
#include "io/FileExtension.h"

namespace pacini::plot
{

namespace
{
std::unique_ptr<Canvas> makeCanvas(PictureFormat format, PictureSize size, const std::string& title)
{
#if PACINI_HAS_CAIRO
    if (format == PictureFormat::png)
        return CairoCanvas::png(size.width, size.height);
    if (format == PictureFormat::pdf)
        return CairoCanvas::pdf(size.width, size.height, title);
#endif
    if (format == PictureFormat::svg)
        return std::make_unique<SvgCanvas>(size.width, size.height, title);
    return nullptr;
}
} // namespace

std::optional<PictureFormat> pictureFormatOf(const std::filesystem::path& path)
{
    const std::string extension = lowerExtension(path);
    if (extension == ".png")
        return PictureFormat::png;
    if (extension == ".svg")
        return PictureFormat::svg;
    if (extension == ".pdf")
        return PictureFormat::pdf;
    return std::nullopt;
}

Result<std::size_t> writePicture(const std::filesystem::path& path, PictureSize size, const std::string& title,
                                 const std::function<void(Canvas&)>& draw, Replaceable replaceable)
{
    const auto format = pictureFormatOf(path);
    if (!format)
        return Error{ErrorCode::invalidArgument, "", "must have the extension .png, .svg or .pdf"};
    const auto canvas = makeCanvas(*format, size, title);
    if (!canvas)
        return Error{ErrorCode::invalidArgument, "", "needs cairo, without which this pacini was built; draw an .svg"};
    draw(*canvas);
    const auto bytes = canvas->finish();
    if (!bytes)
        return bytes.error();
    const auto existing = cli::mayReplace(path, std::string_view(*bytes), replaceable);
    if (!existing)
        return existing.error();
    return writeFileAtomically(path, std::string_view(*bytes), *existing);
}

} // namespace pacini::plot
