#include "io/ClipJson.h"

#include <fmt/compile.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iterator>

namespace pacini
{

namespace
{
/// Builds the text. Members and elements are put down by `line`, which sets commas and indentation, and hands on what
/// is there when that has become much.
class Writer
{
public:
    std::string text;

    explicit Writer(const TextSink& where) : sink(where) {}

    void finish()
    {
        sink(text);
        text.clear();
    }

    void open(char bracket)
    {
        text += bracket;
        ++depth;
        first = true;
    }

    void close(char bracket)
    {
        --depth;
        if (!first)
            newLine();
        text += bracket;
        first = false;
    }

    /// Starts the next member or element on its own line.
    void line()
    {
        if (!first)
            text += ',';
        first = false;
        newLine();
        if (text.size() >= mostKept)
            finish();
    }

    void key(std::string_view name)
    {
        line();
        string(name);
        text += ": ";
    }

    void string(std::string_view value)
    {
        using nlohmann::json;
        text += json(value).dump(-1, ' ', false, json::error_handler_t::replace);
    }

    void number(double value)
    {
        // Minus zero would come back as an integer zero.
        fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}"), value == 0.0 ? 0.0 : value);
    }

    void member(std::string_view name, std::string_view value)
    {
        key(name);
        string(value);
    }

    void member(std::string_view name, double value)
    {
        key(name);
        number(value);
    }

    /// A list of short objects that each have a time: those of one quarter of a second share a line, at most six.
    template <typename Events, typename WriteEvent>
    void timeline(std::string_view name, const Events& events, WriteEvent writeEvent)
    {
        constexpr double linesPerSecond = 4.0;
        constexpr int mostPerLine = 6;
        key(name);
        open('[');
        int onLine = 0;
        double quarter = -1.0;
        for (const auto& event : events)
        {
            const double itsQuarter = std::floor(event.time * linesPerSecond);
            if (onLine == 0 || onLine == mostPerLine || itsQuarter != quarter)
            {
                line();
                onLine = 0;
            }
            else
                text += ", ";
            quarter = itsQuarter;
            ++onLine;
            text += "{\"time\": ";
            number(event.time);
            writeEvent(event);
            text += '}';
        }
        close(']');
    }

    void curve(std::string_view name, const Curve& points, std::string_view valueName)
    {
        timeline(name, points,
                 [&](const Breakpoint& point)
                 {
                     more(valueName);
                     number(point.value);
                 });
    }

    /// The next member of an object on the same line.
    void more(std::string_view name)
    {
        text += ", \"";
        text += name;
        text += "\": ";
    }

private:
    static constexpr std::size_t mostKept = std::size_t(1) << 18;

    const TextSink& sink;
    int depth = 0;
    bool first = true;

    void newLine()
    {
        text += '\n';
        text.append(2 * static_cast<std::size_t>(depth), ' ');
    }
};

void writeSource(Writer& out, const ClipSource& source)
{
    out.key("source");
    out.open('{');
    out.member("file", source.file);
    out.member("sampleRate", source.sampleRate);
    out.member("channels", source.channels);
    out.close('}');
}

void writeEncoder(Writer& out, const std::vector<EncoderParameter>& encoder)
{
    out.key("encoder");
    out.open('{');
    for (const EncoderParameter& parameter : encoder)
    {
        out.key(parameter.name);
        if (const auto* number = std::get_if<double>(&parameter.value))
            out.number(*number);
        else if (const auto* text = std::get_if<std::string>(&parameter.value))
            out.string(*text);
        else
            out.text += std::get<bool>(parameter.value) ? "true" : "false";
    }
    out.close('}');
}

void writeBand(Writer& out, const Band& band)
{
    out.line();
    out.open('{');
    out.member("lowFrequency", band.lowFrequency);
    out.member("centreFrequency", band.centreFrequency);
    out.member("highFrequency", band.highFrequency);
    out.member("priority", band.priority);
    out.curve("amplitude", band.amplitude, "amplitude");
    out.curve("pitch", band.pitch, "frequency");
    out.close('}');
}

void writeNoiseBand(Writer& out, const NoiseBand& band)
{
    out.line();
    out.open('{');
    out.member("lowFrequency", band.lowFrequency);
    out.member("highFrequency", band.highFrequency);
    out.curve("amplitude", band.amplitude, "amplitude");
    out.close('}');
}
} // namespace

std::string writeClipJson(const Clip& clip)
{
    constexpr std::size_t bytesPerPoint = 64;
    std::string text;
    text.reserve(1024 + bytesPerPoint * (breakpointCount(clip) + clip.transients.size()));
    writeClipJson(clip, [&text](std::string_view piece) { text += piece; });
    return text;
}

void writeClipJson(const Clip& clip, const TextSink& sink)
{
    Writer out(sink);
    out.open('{');
    out.member("format", clipFormatName);
    out.member("version", clipFormatVersion);
    out.member("name", clip.name);
    out.member("duration", clip.duration);
    writeSource(out, clip.source);
    writeEncoder(out, clip.encoder);
    out.curve("envelope", clip.envelope, "amplitude");
    out.curve("centroid", clip.centroid, "frequency");
    out.key("bands");
    out.open('[');
    for (const Band& band : clip.bands)
        writeBand(out, band);
    out.close(']');
    out.timeline("transients", clip.transients,
                 [&](const Transient& transient)
                 {
                     out.more("amplitude");
                     out.number(transient.amplitude);
                     out.more("sharpness");
                     out.number(transient.sharpness);
                 });
    out.key("noise");
    out.open('[');
    for (const NoiseBand& band : clip.noise)
        writeNoiseBand(out, band);
    out.close(']');
    out.timeline("markers", clip.markers,
                 [&](const Marker& marker)
                 {
                     out.more("name");
                     out.string(marker.name);
                 });
    out.close('}');
    out.text += '\n';
    out.finish();
}

} // namespace pacini
