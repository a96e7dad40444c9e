#pragma once

// Report of a rendering and of the skipped parts of its plan, as JSON and as text.

#include "cli/RenderJob.h"

#include <nlohmann/json.hpp>

#include <string>

namespace pacini::cli
{

/// The "plan" of a report: sums over all decoders that were described, counts and errors in dB, null where nothing is
/// lost.
[[nodiscard]] nlohmann::ordered_json planJson(const RenderResult& result, const CompileParams& params);

/// {"plays": [...], "adaptations": [...], "leftOut": [...]}: every described play, all adaptations to the actuator and
/// all skipped parts.
[[nodiscard]] nlohmann::ordered_json planLists(const RenderResult& result);

/// The whole report in lines of text, without a line end at the end; of long lists the first entries and the number of
/// further ones.
[[nodiscard]] std::string planText(const RenderResult& result, const CompileParams& params);

} // namespace pacini::cli
