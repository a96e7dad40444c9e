#pragma once

// The output chain of one actuator: equaliser or motor drive, headroom, protection. It computes the drive signal from
// the sum of all plays.

#include <pacini/actuator/LevelLimiter.h>
#include <pacini/actuator/MotorDrive.h>
#include <pacini/actuator/OutputFilter.h>
#include <pacini/actuator/Protection.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/RenderPlan.h>

#include <cstddef>
#include <memory>
#include <span>

namespace pacini
{

/// Output chain of one actuator, for the profile of a plan. Without a profile, full drive is the only
/// limit.
class ActuatorOutput
{
public:
    /// `protect`: keeps the drive within full drive and the limits of the profile; looks ahead by `lookAhead`.
    /// `filtered`: the input has passed the output filter already. Allocates.
    ActuatorOutput(const RenderPlan& plan, const ProcessSpec& spec, bool protect, Seconds lookAhead,
                   bool filtered = false)
    {
        if (!plan.profile)
            addLimiter(spec, lookAhead);
        else
        {
            // Room for overdrive: the rated drive is played at 1 / overdrive.
            scale = 1.0 / plan.profile->drive.overdrive;
            if (plan.motor)
                addMotor(*plan.profile, spec, protect);
            else if (!filtered)
                addFilter(plan, spec);
            if (!plan.motor && protect)
                addProtection(*plan.profile, spec, lookAhead);
        }
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept
    {
        return protection ? protection->latencyFrames() : limiter ? limiter->latencyFrames() : 0;
    }

    /// Activity of the protection in the last call of process(); null without protection. [audio]
    [[nodiscard]] const ProtectionMeter* meter() const noexcept
    {
        return protection ? &protection->meter() : limiter ? &limiter->meter() : nullptr;
    }

    /// In place. [audio]
    void process(std::span<float> samples) noexcept
    {
        if (motor)
            motor->process(samples, samples);
        if (filter)
            filter->process(samples, samples);
        if (scale != 1.0)
            for (float& sample : samples)
                sample = static_cast<float>(scale * static_cast<double>(sample));
        if (protection)
            protection->process(samples, samples);
        if (limiter)
            limiter->process(samples, samples);
    }

private:
    void addLimiter(const ProcessSpec& spec, Seconds lookAhead)
    {
        limiter = std::make_unique<LevelLimiter>();
        limiter->prepare(spec);
        LevelLimiterParams params;
        params.lookAhead = lookAhead;
        limiter->setParams(params);
        limiter->reset();
    }

    void addMotor(const Profile& profile, const ProcessSpec& spec, bool protect)
    {
        motor = std::make_unique<MotorDrive>();
        motor->prepare(spec);
        MotorDriveParams params = motorDriveParams(profile);
        if (!protect)
            params.heat.reset();
        motor->setParams(params);
    }

    void addFilter(const RenderPlan& plan, const ProcessSpec& spec)
    {
        filter = std::make_unique<OutputFilter>();
        filter->prepare(spec);
        filter->setParams({plan.profile->equalizer, plan.flattening});
        if (filter->coefficients().sections.empty())
            filter.reset();
    }

    void addProtection(const Profile& profile, const ProcessSpec& spec, Seconds lookAhead)
    {
        protection = std::make_unique<Protection>();
        protection->prepare(spec);
        protection->setParams(protectionParams(profile, lookAhead));
        protection->reset();
    }

    std::unique_ptr<OutputFilter> filter;
    std::unique_ptr<MotorDrive> motor;
    std::unique_ptr<Protection> protection;
    std::unique_ptr<LevelLimiter> limiter; ///< where there is no profile
    double scale = 1.0;
};

} // namespace pacini
