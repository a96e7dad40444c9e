// An actuator's response and the equaliser that flattens it, on a rig that is simulated: measure > sections.txt

#include <pacini/linearize/EqualizerFit.h>
#include <pacini/linearize/SimulatedRig.h>
#include <pacini/linearize/SweepAnalysis.h>

#include <cstdio>

int main()
{
    pacini::SweepParams sweep;
    sweep.duration = 5.0;
    const auto drive = pacini::makeSweepSignal(sweep);
    if (!drive)
        return std::fprintf(stderr, "measure: %s\n", drive.error().text().c_str()), 1;

    // With a real one: play the drive, record the accelerometer.
    const pacini::RigParams rig;
    const auto recording = pacini::recordOnRig(*drive, rig);
    pacini::MeasurementParams measurement;
    measurement.fullScale = {rig.range}; // m/s^2 of a sample of 1
    const auto measured = pacini::analyseSweeps(recording, rig.sampleRate, sweep, measurement);
    if (!measured)
        return std::fprintf(stderr, "measure: %s\n", measured.error().text().c_str()), 1;

    pacini::EqualizerFitParams wanted;
    wanted.lowFrequency = 30.0;
    wanted.highFrequency = 500.0;
    const auto fit = pacini::fitEqualizer(measured->response(), wanted);
    if (!fit)
        return std::fprintf(stderr, "measure: %s\n", fit.error().text().c_str()), 1;
    for (const pacini::EqualizerSection& section : fit->sections)
        std::printf("%.1f Hz %+.2f dB Q %.2f\n", section.frequency, section.gain, section.q);
    std::fprintf(stderr, "flat within %.2f dB RMS, %.2f dB at most\n", fit->rms, fit->max);
    return 0;
}
