#include "io/formats/ForeignText.h"
#include "io/formats/LossList.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/tact/TactFormat.h"

#include <pacini/foundation/NumberText.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pacini
{

namespace
{
constexpr double frame = static_cast<double>(tactFrame) / 1000.0; // s
constexpr std::array<const char*, 2> positions{"ForearmL", "ForearmR"};
} // namespace

Result<ExportedClip> writeTact(const Clip& clip, const ExportParams& params)
{
    auto [voice, losses] = reducedStrength(clip, params, tactMotorFrequency);
    losses.addCrowding(voice.events, 2.0 * frame);
    losses.add(LossKind::timeStep, 0.0, clip.duration, 0.5 * frame, "times are rounded to frames of 20 ms");
    std::vector<double> levels = strengthOf(voice, frame, frame);
    std::string feedback;
    const auto count = static_cast<std::int64_t>(levels.size());
    for (std::int64_t from = 0, to = 0; from < count; from = to)
    {
        const auto levelAt = [&](std::int64_t n)
        {
            return std::round(1000.0 * std::min(levels[static_cast<std::size_t>(n)], 1.0)) / 1000.0;
        };
        for (to = from + 1; to < count && levelAt(to) == levelAt(from);)
            ++to;
        if (levelAt(from) > 0.0)
            feedback += fmt::format(R"({}
                  {{"startTime": {}, "endTime": {}, "playbackType": "NONE", "pointList": [{{"index": 1, "intensity": {}}}]}})",
                                    feedback.empty() ? "" : ",", tactFrame * from, tactFrame * to,
                                    shortDecimalText(levelAt(from), 3));
    }
    std::string modes, layouts;
    for (const char* position : positions)
    {
        modes += fmt::format(R"({}
              "{}": {{
                "mode": "DOT_MODE",
                "dotMode": {{"dotConnected": false, "feedback": [{}]}},
                "pathMode": {{"feedback": []}}
              }})",
                             modes.empty() ? "" : ",", position, feedback);
        layouts += fmt::format(R"({}"{}": [{{"index": 0, "x": 0, "y": 0.5}}, {{"index": 1, "x": 0.5, "y": 0.5}}, )"
                               R"({{"index": 2, "x": 1, "y": 0.5}}])",
                               layouts.empty() ? "" : ", ", position);
    }
    const std::int64_t end = tactFrame * count;
    const std::string name = inQuotes(nameOfClip(clip, params.name));
    return oneFile(fmt::format(R"({{
  "project": {{
    "name": {},
    "createdAt": 0,
    "mediaFileDuration": {},
    "layout": {{"name": "Tactosy for arms", "type": "Tactosy", "layouts": {{{}}}}},
    "tracks": [
      {{
        "enable": true,
        "effects": [
          {{
            "name": {},
            "startTime": 0,
            "offsetTime": {},
            "modes": {{{}
            }}
          }}
        ]
      }}
    ]
  }},
  "durationMillis": {},
  "intervalMillis": 20,
  "size": 20
}}
)",
                               name, shortDecimalText(static_cast<double>(end) / 1000.0, 3), layouts, name, end, modes,
                               end),
                   std::move(losses));
}

} // namespace pacini
