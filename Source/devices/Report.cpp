#include "devices/Report.h"

#include <algorithm>

namespace pacini::devices
{

Report::Report(std::span<const std::byte> content, ReportWay goes) noexcept : used(content.size()), way(goes)
{
    std::copy(content.begin(), content.end(), bytes.begin());
}

} // namespace pacini::devices
