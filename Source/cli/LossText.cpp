#include "cli/LossText.h"

#include "cli/Console.h"

#include <fmt/format.h>

namespace pacini::cli
{

namespace
{
/// "0.25 octaves"
std::string errorText(const FormatLoss& loss)
{
    if (loss.error <= 0.0)
        return "";
    if (loss.kind == LossKind::frequency)
        return fmt::format("{:.2f} octaves", loss.error);
    if (isTime(loss.kind))
        return fmt::format("{:.2g} ms", 1000.0 * loss.error);
    return fmt::format("{:.3f}", loss.error);
}
} // namespace

bool isTime(LossKind kind)
{
    return kind == LossKind::timeStep || kind == LossKind::length;
}

std::string lossLine(const std::string& file, const FormatLoss& loss)
{
    return fmt::format("{}: {:8.3f} s {:>7}  {:<10}{:>13}  {}", printable(file), loss.time,
                       loss.duration > 0.0 ? fmt::format("+{:.3f}", loss.duration) : "", lossName(loss.kind),
                       errorText(loss), loss.message);
}

} // namespace pacini::cli
