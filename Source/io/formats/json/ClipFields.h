#pragma once

// Field lists of a clip in JSON, which its reader, its writer and its seal follow.

#include "io/Fields.h"
#include "io/formats/json/ClipJson.h"

#include <pacini/clip/Clip.h>

#include <cstdint>

namespace pacini::clipFields
{

inline constexpr DocumentFormat format{clipFormatName, clipFormatVersion, "a clip", true};

inline constexpr auto amplitudePointFields = [](auto& point, auto& visitor)
{
    visitor.number("time", point.time, Need::required);
    visitor.number("amplitude", point.value, Need::required);
};

inline constexpr auto frequencyPointFields = [](auto& point, auto& visitor)
{
    visitor.number("time", point.time, Need::required);
    visitor.number("frequency", point.value, Need::required);
};

inline constexpr auto sourceFields = [](auto& source, auto& visitor)
{
    visitor.text("file", source.file, Need::usual);
    visitor.number("sampleRate", source.sampleRate, Need::usual);
    visitor.integer("channels", source.channels);
};

inline constexpr auto bandFields = [](auto& band, auto& visitor)
{
    visitor.number("lowFrequency", band.lowFrequency, Need::required);
    visitor.number("centreFrequency", band.centreFrequency, Need::required);
    visitor.number("highFrequency", band.highFrequency, Need::required);
    visitor.integer("priority", band.priority);
    visitor.timeline("amplitude", band.amplitude, Need::required, amplitudePointFields);
    visitor.timeline("pitch", band.pitch, Need::usual, frequencyPointFields);
    visitor.number("phase", band.phase, Need::optional);
};

inline constexpr auto transientFields = [](auto& transient, auto& visitor)
{
    visitor.number("time", transient.time, Need::required);
    visitor.number("amplitude", transient.amplitude, Need::required);
    visitor.number("sharpness", transient.sharpness, Need::required);
};

inline constexpr auto noiseBandFields = [](auto& band, auto& visitor)
{
    visitor.number("lowFrequency", band.lowFrequency, Need::required);
    visitor.number("highFrequency", band.highFrequency, Need::required);
    visitor.timeline("amplitude", band.amplitude, Need::required, amplitudePointFields);
};

inline constexpr auto markerFields = [](auto& marker, auto& visitor)
{
    visitor.number("time", marker.time, Need::required);
    visitor.text("name", marker.name);
};

inline constexpr auto document = [](auto& clip, auto& visitor)
{
    visitor.format(format);
    visitor.text("name", clip.name, Need::usual);
    visitor.number("duration", clip.duration, Need::required);
    visitor.object("source", clip.source, Need::usual, sourceFields);
    visitor.parameters("encoder", clip.encoder);
    visitor.timeline("envelope", clip.envelope, Need::usual, amplitudePointFields);
    visitor.timeline("centroid", clip.centroid, Need::usual, frequencyPointFields);
    visitor.list("bands", clip.bands, limits::bands, "bands that a clip may have", bandFields, Need::required);
    visitor.timeline("transients", clip.transients, Need::usual, transientFields);
    visitor.list("noise", clip.noise, SIZE_MAX, "", noiseBandFields, Need::usual);
    visitor.timeline("markers", clip.markers, Need::usual, markerFields);
};

/// A clip inside another document, which is checked when it is complete.
inline constexpr auto embedded = [](Clip& clip, auto& visitor)
{
    document(clip, visitor);
    visitor.check(
        [&]() -> Result<void>
        {
            auto valid = validate(clip);
            if (!valid && !valid.error().where.empty())
                return Error{valid.error().code, "." + valid.error().where, valid.error().message};
            return valid;
        });
};

} // namespace pacini::clipFields
