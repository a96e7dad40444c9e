#pragma once

// Field lists of an actuator profile in JSON, which its reader and its writer follow.

#include "io/Fields.h"

#include <pacini/actuator/Profile.h>

#include <array>

namespace pacini::profileFields
{

inline constexpr std::array<Choice<Technology>, 6> technologies{{{"erm", Technology::erm},
                                                                 {"lra", Technology::lra},
                                                                 {"piezo", Technology::piezo},
                                                                 {"eap", Technology::eap},
                                                                 {"vca", Technology::vca},
                                                                 {"pcm", Technology::pcm}}};
inline constexpr std::array<Choice<FrequencyMapping>, 3> frequencyMappings{
    {{"clamp", FrequencyMapping::clamp}, {"rescale", FrequencyMapping::rescale}, {"fold", FrequencyMapping::fold}}};
inline constexpr std::array<Choice<TransientShape>, 3> transientShapes{
    {{"adaptive", TransientShape::adaptive}, {"square", TransientShape::square}, {"sine", TransientShape::sine}}};
inline constexpr std::array<Choice<EqualizerType>, 4> equalizerTypes{{{"peak", EqualizerType::peak},
                                                                      {"lowShelf", EqualizerType::lowShelf},
                                                                      {"highShelf", EqualizerType::highShelf},
                                                                      {"highpass", EqualizerType::highpass}}};

/// The entries of a measurement, see visitFields().
template <typename AnyMeasurement, typename Visitor>
void visitMeasurement(AnyMeasurement& measurement, Visitor& visitor)
{
    using enum Need;
    visitor.integer("fittings", measurement.placements, "must be a whole number, 1 to 1000000");
    visitor.number("drive", measurement.drive, usual);
    visitor.optionalNumber("distortionDrive", measurement.distortionDrive);
    visitor.optionalObject(
        "linearity", measurement.linearity,
        [&](auto& linearity)
        {
            visitNumbers(visitor, required, "lowFrequency", linearity.lowFrequency, "highFrequency",
                         linearity.highFrequency, "tolerance", linearity.tolerance, "level", linearity.level,
                         "meanDeviation", linearity.meanDeviation, "standardDeviation", linearity.standardDeviation,
                         "worstDeviation", linearity.worstDeviation, "worstFrequency", linearity.worstFrequency);
            visitor.list("outliers", linearity.outliers, ProfileMeasurement::maxOutliers, "outliers",
                         [&](auto& outlier)
                         {
                             visitNumbers(visitor, required, "lowFrequency", outlier.lowFrequency, "highFrequency",
                                          outlier.highFrequency, "deviation", outlier.deviation);
                         });
        });
    visitor.list("points", measurement.points, ProfileMeasurement::maxPoints, "points",
                 [&](auto& point)
                 {
                     visitor.number("frequency", point.frequency, required);
                     visitor.number("level", point.level, required);
                     visitor.optionalNumber("linearised", point.linearised);
                 });
}

/// Shows `visitor` (FieldsReader or FieldsWriter) all entries of `profile` (a Profile, const for a writer) in the order
/// of the file.
template <typename AnyProfile, typename Visitor>
void visitFields(AnyProfile& profile, Visitor& visitor)
{
    using enum Need;
    visitor.text("name", profile.name);
    visitor.optionalText("shortName", profile.shortName);
    visitor.choice("technology", profile.technology, technologies, required);
    visitor.object("resonance", profile.resonance, required,
                   [&](auto& resonance)
                   {
                       visitor.number("frequency", resonance.frequency, required);
                       visitor.number("q", resonance.q, usual);
                   });
    visitor.object("range", profile.range, usual,
                   [&](auto& range)
                   {
                       visitNumbers(visitor, usual, "lowFrequency", range.lowFrequency, "highFrequency",
                                    range.highFrequency, "dynamicRange", range.dynamicRange);
                   });
    visitor.object("response", profile.response, optional,
                   [&](auto& response)
                   {
                       visitor.number("riseTime", response.riseTime, usual);
                       visitor.number("fallTime", response.fallTime, usual);
                   });
    visitor.integer("polyphony", profile.polyphony, "must be a whole number of voices, 0 to 64");
    visitor.choice("frequencyMapping", profile.frequencyMapping, frequencyMappings, usual);
    visitor.object("drive", profile.drive, optional,
                   [&](auto& drive)
                   {
                       visitor.optionalNumber("impedance", drive.impedance);
                       visitor.optionalNumber("maxVoltageRms", drive.maxVoltageRms);
                       visitor.optionalNumber("maxPower", drive.maxPower);
                       visitor.optionalNumber("thermalTime", drive.thermalTime);
                       visitor.optionalNumber("maxExcursion", drive.maxExcursion);
                       visitor.optionalNumber("excursion", drive.excursion);
                       visitor.number("overdrive", drive.overdrive, usual);
                   });
    visitor.list("equalizer", profile.equalizer, profile.equalizer.capacity(), "sections",
                 [&](auto& section)
                 {
                     visitor.choice("type", section.type, equalizerTypes, required);
                     visitor.number("frequency", section.frequency, required);
                     visitor.number("gain", section.gain, section.type == EqualizerType::highpass ? usual : required);
                     visitor.number("q", section.q, usual);
                     visitor.integer("order", section.order, "must be a whole number, 1 to 8");
                 });
    visitor.object("transient", profile.transient, optional,
                   [&](auto& transient)
                   {
                       visitor.choice("shape", transient.shape, transientShapes, usual);
                       visitor.number("frequency", transient.frequency, usual);
                       visitor.number("cycles", transient.cycles, usual);
                   });
    visitor.optionalObject("body", profile.body,
                           [&](auto& body)
                           {
                               visitNumbers(visitor, usual, "force", body.force, "movingMass", body.movingMass,
                                            "deviceMass", body.deviceMass, "jointStiffness", body.jointStiffness,
                                            "jointDamping", body.jointDamping, "skinMass", body.skinMass,
                                            "skinStiffness", body.skinStiffness, "skinDamping", body.skinDamping);
                           });
    visitor.optionalObject("measurement", profile.measurement,
                           [&](auto& measurement) { visitMeasurement(measurement, visitor); });
    visitor.texts("sources", profile.sources);
}

} // namespace pacini::profileFields
