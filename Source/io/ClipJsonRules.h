#pragma once

// The entries of a clip in JSON: names, kinds, what is required and where each goes.

#include <pacini/clip/Clip.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace pacini::clipJson
{

/// The clip as it grows; `curve` is the one whose points are being read.
struct Draft
{
    Clip clip;
    Curve* curve = nullptr;
};

enum class Kind
{
    number,
    integer, ///< a number without fraction that fits int
    text,
    object,
    list, ///< of objects
};

struct ObjectRules;

/// One named entry of an object: what it must be and where it goes.
struct Member
{
    std::string_view name;
    Kind kind;
    bool required;
    void (*storeNumber)(Draft&, double);
    void (*storeText)(Draft&, std::string&);
    void (*enter)(Draft&);     ///< called when the object or list opens; may be null
    const ObjectRules* inside; ///< rules of the object, or of each object in the list
};

/// The entries that an object may have. Others are ignored.
struct ObjectRules
{
    std::span<const Member> members;
    void (*begin)(Draft&); ///< appends the object to its list; null for a single object
};

inline constexpr bool required = true;
inline constexpr bool optional = false;

constexpr Member number(std::string_view name, bool isRequired, void (*store)(Draft&, double))
{
    return {name, Kind::number, isRequired, store, nullptr, nullptr, nullptr};
}

constexpr Member integer(std::string_view name, bool isRequired, void (*store)(Draft&, double))
{
    return {name, Kind::integer, isRequired, store, nullptr, nullptr, nullptr};
}

constexpr Member text(std::string_view name, bool isRequired, void (*store)(Draft&, std::string&))
{
    return {name, Kind::text, isRequired, nullptr, store, nullptr, nullptr};
}

constexpr Member object(std::string_view name, bool isRequired, const ObjectRules& rules)
{
    return {name, Kind::object, isRequired, nullptr, nullptr, nullptr, &rules};
}

constexpr Member list(std::string_view name, bool isRequired, const ObjectRules& rules, void (*enter)(Draft&) = nullptr)
{
    return {name, Kind::list, isRequired, nullptr, nullptr, enter, &rules};
}

// The format, from the inside out.

inline constexpr Member amplitudePointMembers[] = {
    number("time", required, [](Draft& d, double v) { d.curve->back().time = v; }),
    number("amplitude", required, [](Draft& d, double v) { d.curve->back().value = v; }),
};
inline constexpr ObjectRules amplitudePoint{amplitudePointMembers, [](Draft& d)
                                            {
                                                d.curve->emplace_back();
                                            }};

inline constexpr Member frequencyPointMembers[] = {
    number("time", required, [](Draft& d, double v) { d.curve->back().time = v; }),
    number("frequency", required, [](Draft& d, double v) { d.curve->back().value = v; }),
};
inline constexpr ObjectRules frequencyPoint{frequencyPointMembers, [](Draft& d)
                                            {
                                                d.curve->emplace_back();
                                            }};

inline constexpr Member sourceMembers[] = {
    text("file", optional, [](Draft& d, std::string& v) { d.clip.source.file = std::move(v); }),
    number("sampleRate", optional, [](Draft& d, double v) { d.clip.source.sampleRate = v; }),
    integer("channels", optional, [](Draft& d, double v) { d.clip.source.channels = static_cast<int>(v); }),
};
inline constexpr ObjectRules source{sourceMembers, nullptr};

// Its names are free: the reader treats it by itself.
inline constexpr ObjectRules encoder{{}, nullptr};

inline constexpr Member bandMembers[] = {
    number("lowFrequency", required, [](Draft& d, double v) { d.clip.bands.back().lowFrequency = v; }),
    number("centreFrequency", required, [](Draft& d, double v) { d.clip.bands.back().centreFrequency = v; }),
    number("highFrequency", required, [](Draft& d, double v) { d.clip.bands.back().highFrequency = v; }),
    integer("priority", optional, [](Draft& d, double v) { d.clip.bands.back().priority = static_cast<int>(v); }),
    list("amplitude", required, amplitudePoint, [](Draft& d) { d.curve = &d.clip.bands.back().amplitude; }),
    list("pitch", optional, frequencyPoint, [](Draft& d) { d.curve = &d.clip.bands.back().pitch; }),
};
inline constexpr ObjectRules band{bandMembers, [](Draft& d)
                                  {
                                      d.clip.bands.emplace_back();
                                  }};

inline constexpr Member transientMembers[] = {
    number("time", required, [](Draft& d, double v) { d.clip.transients.back().time = v; }),
    number("amplitude", required, [](Draft& d, double v) { d.clip.transients.back().amplitude = v; }),
    number("sharpness", required, [](Draft& d, double v) { d.clip.transients.back().sharpness = v; }),
};
inline constexpr ObjectRules transient{transientMembers, [](Draft& d)
                                       {
                                           d.clip.transients.emplace_back();
                                       }};

inline constexpr Member noiseBandMembers[] = {
    number("lowFrequency", required, [](Draft& d, double v) { d.clip.noise.back().lowFrequency = v; }),
    number("highFrequency", required, [](Draft& d, double v) { d.clip.noise.back().highFrequency = v; }),
    list("amplitude", required, amplitudePoint, [](Draft& d) { d.curve = &d.clip.noise.back().amplitude; }),
};
inline constexpr ObjectRules noiseBand{noiseBandMembers, [](Draft& d)
                                       {
                                           d.clip.noise.emplace_back();
                                       }};

inline constexpr Member markerMembers[] = {
    number("time", required, [](Draft& d, double v) { d.clip.markers.back().time = v; }),
    text("name", required, [](Draft& d, std::string& v) { d.clip.markers.back().name = std::move(v); }),
};
inline constexpr ObjectRules marker{markerMembers, [](Draft& d)
                                    {
                                        d.clip.markers.emplace_back();
                                    }};

inline constexpr Member clipMembers[] = {
    text("format", required, [](Draft&, std::string&) {}),
    integer("version", required, [](Draft&, double) {}),
    text("name", optional, [](Draft& d, std::string& v) { d.clip.name = std::move(v); }),
    number("duration", required, [](Draft& d, double v) { d.clip.duration = v; }),
    object("source", optional, source),
    object("encoder", optional, encoder),
    list("envelope", optional, amplitudePoint, [](Draft& d) { d.curve = &d.clip.envelope; }),
    list("centroid", optional, frequencyPoint, [](Draft& d) { d.curve = &d.clip.centroid; }),
    list("bands", required, band),
    list("transients", optional, transient),
    list("noise", optional, noiseBand),
    list("markers", optional, marker),
};
inline constexpr ObjectRules clipRules{clipMembers, nullptr};
inline constexpr const Member& formatMember = clipMembers[0];
inline constexpr const Member& versionMember = clipMembers[1];

} // namespace pacini::clipJson
