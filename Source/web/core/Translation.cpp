// The live translator, block by block: for an audio worklet, which calls nothing else.

#include "io/ProfileJson.h"

#include <pacini/realtime/Translator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace
{
constexpr std::uint32_t mostFrames = 1024;

/// A translator and the buffers that JavaScript fills and reads.
struct LiveTranslator
{
    pacini::Translator translator;
    std::array<float, mostFrames> in{}, out{};
    std::array<double, pacini::translatorParameters.size()> values{}; ///< of the parameters, in their order

    /// Values out of range are clamped.
    void takeValues()
    {
        pacini::TranslatorParams params;
        for (std::size_t i = 0; i < values.size(); ++i)
            pacini::translatorParameters[i].set(params, values[i]);
        translator.setParams(params);
    }
};
} // namespace

extern "C"
{
    /// For sound at `rate` Hz and the actuator of a profile (JSON), or none; null where either is not possible. NaN is
    /// the usual value.
    [[clang::export_name("translatorCreate")]] LiveTranslator* paciniTranslatorCreate(double rate, const char* profile,
                                                                                      std::uint32_t length,
                                                                                      double bands, double maxBoost,
                                                                                      double strength)
    {
        using namespace pacini;
        if (!isPlayableRate(rate))
            return nullptr;
        TranslatorSetup setup;
        if (length > 0)
        {
            auto read = readProfileJson(std::string_view(profile, length));
            if (!read)
                return nullptr;
            setup.profile = std::move(*read);
        }
        if (!std::isnan(bands))
            setup.bands.bands = static_cast<std::size_t>(bands);
        if (!std::isnan(maxBoost))
            setup.maxBoost = Decibels(maxBoost);
        if (!std::isnan(strength))
            setup.strength = strength;
        auto live = std::make_unique<LiveTranslator>();
        ProcessSpec spec;
        spec.sampleRate = rate;
        live->translator.setSetup(setup);
        live->translator.prepare(spec);
        live->translator.reset();
        for (std::size_t i = 0; i < live->values.size(); ++i)
            live->values[i] = translatorParameters[i].usual();
        return live.release();
    }

    [[clang::export_name("translatorRelease")]] void paciniTranslatorRelease(LiveTranslator* live)
    {
        delete live;
    }

    [[clang::export_name("translatorIn")]] float* paciniTranslatorIn(LiveTranslator* live)
    {
        return live->in.data();
    }
    [[clang::export_name("translatorOut")]] const float* paciniTranslatorOut(LiveTranslator* live)
    {
        return live->out.data();
    }
    /// Where the values of the parameters are written, in the order of their descriptions.
    [[clang::export_name("translatorValues")]] double* paciniTranslatorValues(LiveTranslator* live)
    {
        return live->values.data();
    }
    /// Takes them, smoothly; allocates nothing.
    [[clang::export_name("translatorSet")]] void paciniTranslatorSet(LiveTranslator* live)
    {
        live->takeValues();
    }
    [[clang::export_name("translatorReset")]] void paciniTranslatorReset(LiveTranslator* live)
    {
        live->translator.reset();
    }
    [[clang::export_name("translatorLatency")]] std::uint32_t paciniTranslatorLatency(const LiveTranslator* live)
    {
        return static_cast<std::uint32_t>(live->translator.latencyFrames());
    }

    /// So many frames, at most 1024, from the one buffer to the other. Allocates nothing.
    [[clang::export_name("translatorProcess")]] void paciniTranslatorProcess(LiveTranslator* live, std::uint32_t frames)
    {
        const std::size_t count = std::min(frames, mostFrames);
        live->translator.process(std::span<const float>(live->in).first(count), std::span(live->out).first(count));
    }
}
