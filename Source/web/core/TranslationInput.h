#pragma once

// The translation of a call: its own options override those of its `settings`.

#include "io/Settings.h"
#include "web/core/Call.h"

namespace pacini::web
{

/// Errors: those of translationOf(); errors of single options are stored in the reader.
[[nodiscard]] inline Result<TranslationParams> readTranslation(Call& call)
{
    Settings settings;
    call.reader.object("settings", settings, Need::optional,
                       [&](Settings& into) { readSettingsFields(call.reader, into); });
    readEncodeSettings(call.reader, settings);
    return translationOf(settings);
}

} // namespace pacini::web
