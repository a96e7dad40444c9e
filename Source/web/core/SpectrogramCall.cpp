// The call `spectrogram`: the colours of a stretch of a sound, as the editor shows it.

#include "document/view/ColourMap.h"
#include "document/view/SpectrumAnalyzer.h"
#include "web/core/Call.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::web
{

Result<void> drawSpectrogram(Call& call)
{
    const double rate = call.number("sampleRate", 48000.0, 2000.0, 768000.0);
    const double from = call.number("from", 0.0, -1e6, 1e6);
    const double to = call.number("to", 0.0, -1e6, 1e6);
    const auto columns = static_cast<std::size_t>(call.number("columns", 800.0, 1.0, 4096.0));
    const bool dark = call.truth("dark", true);
    SpectrumRows rows;
    rows.high = std::max(100.0, std::min(call.number("high", rows.high, 100.0, 96000.0), 0.5 * rate));
    if (call.reader.error)
        return {};
    SpectrumAnalyzer analyser(MonoSource(call.samples(0)), rate, rows);
    const auto colours = levelColours(dark);
    std::vector<std::uint8_t> levels(rows.count);
    std::string pixels(4 * columns * rows.count, '\xff'); // red, green, blue, opacity; the first row is the highest
    for (std::size_t x = 0; x < columns; ++x)
    {
        const double share = (static_cast<double>(x) + 0.5) / static_cast<double>(columns);
        analyser.column(from + share * (to - from), levels);
        for (std::size_t y = 0; y < rows.count; ++y)
        {
            const std::uint32_t colour = colours[levels[rows.count - 1 - y]];
            char* pixel = pixels.data() + 4 * (y * columns + x);
            pixel[0] = static_cast<char>(colour >> 16);
            pixel[1] = static_cast<char>(colour >> 8);
            pixel[2] = static_cast<char>(colour);
        }
    }
    call.value = {{"width", columns}, {"height", rows.count}, {"low", rows.low}, {"high", rows.high}};
    call.put(std::string_view(pixels));
    return {};
}

} // namespace pacini::web
