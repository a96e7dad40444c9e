// The call `reports`: the bytes that play a clip on a game controller, each with its time.

#include "devices/ClipRumble.h"
#include "devices/InstantClock.h"
#include "devices/RumblePlayback.h"
#include "web/core/Call.h"

#include <pacini/foundation/Units.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace pacini::web
{

namespace
{
/// Notes the reports of a playback whose clock does not wait.
class ReportList : public devices::ReportSink
{
public:
    explicit ReportList(const devices::SendClock& clockToRead) : clock(clockToRead) {}

    void prepare(const devices::StopReports& given) override { stops = given; }

    Result<void> send(const devices::Report& report) override
    {
        add(list, report, clock.now().value);
        return {};
    }

    /// The reports, one behind another, and where each begins.
    void put(Call& call) const
    {
        call.value["reports"] = list.index;
        call.put(std::string_view(list.bytes));
        // WebHID sees a device at another moment than the counter of the last report: silence for each of its values.
        Part silent;
        for (const devices::StopReport& stop : stops)
            for (const devices::Report& report : {stop.report, stop.also})
                if (!report.content().empty())
                    add(silent, report, 0.0);
        call.value["stops"] = silent.index;
        call.put(std::string_view(silent.bytes));
    }

private:
    struct Part
    {
        Json index = Json::array();
        std::string bytes;
    };

    static void add(Part& part, const devices::Report& report, double time)
    {
        const auto content = report.content();
        part.index.push_back(
            {{"time", time}, {"at", part.bytes.size()}, {"length", content.size()}, {"feature", report.isFeature()}});
        part.bytes.append(reinterpret_cast<const char*>(content.data()), content.size());
    }

    const devices::SendClock& clock;
    devices::StopReports stops{};
    Part list;
};
} // namespace

Result<void> listReports(Call& call)
{
    const double highest = 65535.0;
    const auto maker = static_cast<std::uint16_t>(call.number("vendor", 0.0, 0.0, highest));
    const auto product = static_cast<std::uint16_t>(call.number("product", 0.0, 0.0, highest));
    const bool bluetooth = call.truth("bluetooth", false);
    const double gain = call.number("gain", 0.0, -100.0, 20.0);
    if (call.reader.error)
        return {};
    const auto haptics = devices::controllerHaptics(maker, product);
    if (!haptics || *haptics == devices::ControllerHaptics::waveforms)
        return Error{ErrorCode::invalidArgument, fmt::format("{:04x}:{:04x}", maker, product),
                     "is not a controller with known reports"};
    const auto model = devices::usualModel(
        *haptics, devices::transportByProduct(*haptics, product)
                      .value_or(bluetooth ? devices::Transport::bluetooth : devices::Transport::usb));
    auto clip = clipOf(call, 0);
    if (!clip)
        return clip.error();
    const devices::PlayRange range{Seconds(0.0), Seconds(clip->duration)};
    devices::ClipRumble rumble(*clip, range, Decibels(gain), model);
    devices::InstantClock clock;
    ReportList list(clock);
    devices::RumblePlayback playback(model, rumble, list, clock);
    if (auto played = playback.run(); !played)
        return played.error();
    list.put(call);
    return {};
}

} // namespace pacini::web
