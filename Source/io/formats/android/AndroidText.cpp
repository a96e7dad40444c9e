#include "io/formats/android/AndroidText.h"

#include "io/formats/ForeignText.h"

#include <fmt/format.h>

#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t perLine = 12;
} // namespace

std::string timingsOf(const std::vector<AndroidStep>& steps, const char* indent)
{
    return numbersInLines(
        steps, perLine, [](const AndroidStep& step) { return fmt::format("{}", step.duration); }, indent);
}

std::string amplitudesOf(const std::vector<AndroidStep>& steps, const char* indent)
{
    return numbersInLines(
        steps, perLine, [](const AndroidStep& step) { return fmt::format("{}", step.amplitude); }, indent);
}

ExportedClip oneFile(std::string text, std::vector<FormatLoss> losses)
{
    return {{{"", std::move(text)}}, std::move(losses)};
}

} // namespace pacini
