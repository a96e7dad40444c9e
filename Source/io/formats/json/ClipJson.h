#pragma once

// Clips as JSON text: Resources/schema/pacini.clip.schema.json describes the format.

#include "io/JsonText.h"
#include "io/ReadWarnings.h"

#include <pacini/clip/Clip.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace pacini
{

inline constexpr std::string_view clipFormatName = "pacini.clip";
inline constexpr int clipFormatVersion = 1;

/// Longer texts are refused. About ten million points fit.
inline constexpr std::size_t largestClipText = std::size_t(512) << 20;

/// Reads a clip and checks it with validate(). Unknown keys are passed over with a warning each, if `warnings` are
/// asked for; a key given twice is an error (programs differ in which one they take). `format`, `version`, `duration`
/// and `bands` are required, and in every listed object all members but a band's `priority`, `pitch` and `phase`; what
/// may be missing keeps the default of Clip. Errors carry the place: a path such as `bands[2].amplitude[7].time` for a
/// wrong, missing or badly ordered value (the path of the missing member), `line 3, column 17` for wrong JSON. Codes:
/// invalidData, unsupportedVersion, notFinite (numbers beyond double), tooLarge (longer than `maximumBytes`, nested
/// deeper than 32, beyond the limits of Clip.h).
[[nodiscard]] Result<Clip> readClipJson(std::string_view text, std::size_t maximumBytes = largestClipText,
                                        ReadWarnings* warnings = nullptr);

/// The text of a clip for which validate() holds: UTF-8, all members in the order of the schema, the points of one
/// quarter of a second on one line (an edit changes few lines), and numbers in the shortest form that reads back
/// exactly. readClipJson(writeClipJson(clip)) == clip, except that bytes which are not UTF-8 become U+FFFD.
[[nodiscard]] std::string writeClipJson(const Clip& clip);

/// The same text in pieces of some 256 kB, for long clips: its points take two times their memory as text.
void writeClipJson(const Clip& clip, const TextSink& sink);

} // namespace pacini
