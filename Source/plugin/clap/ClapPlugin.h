// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An instance of the plugin, as CLAP hosts see it.

#include "plugin/clap/Clap.h"
#include "plugin/clap/ClapAudio.h"
#include "plugin/clap/ClapEventLoop.h"
#include "plugin/clap/ClapWindow.h"
#include "plugin/clap/ParameterReports.h"
#include "plugin/window/Plugin.h"

#include <atomic>
#include <memory>

namespace pacini::plugin
{

/// What the host knows of it is `clap_plugin`, whose functions it calls; destroy() ends it. Threads are those of CLAP:
/// [main], and [audio] while it is active.
class ClapPlugin
{
public:
    /// A new instance that the host owns. [any]
    [[nodiscard]] static const clap_plugin_t* make(const clap_host_t& host, const clap_plugin_descriptor_t& described);
    /// The instance behind a plugin of the host.
    [[nodiscard]] static ClapPlugin& of(const clap_plugin_t* plugin) noexcept
    {
        return *static_cast<ClapPlugin*>(plugin->plugin_data);
    }
    ClapPlugin(const ClapPlugin&) = delete;
    ClapPlugin& operator=(const ClapPlugin&) = delete;
    ~ClapPlugin();

    [[nodiscard]] PluginProcessor& processor() const noexcept { return parts->processor; }
    [[nodiscard]] ClapWindow& window() const noexcept { return parts->window; }
    [[nodiscard]] bool isActive() const noexcept { return active; }

    /// Applies the host's events, and gives it what the user changed. [audio], or [main] while it is not active
    void flush(const clap_input_events_t* in, const clap_output_events_t* out) noexcept;
    /// The state, and whether that succeeded. [main]
    bool save(const clap_ostream_t& stream);
    bool load(const clap_istream_t& stream);
    /// Whether the host renders offline. [main]
    bool setRenderMode(clap_plugin_render_mode mode);
    /// [main]
    void onTimer(clap_id id) { loop->onTimer(id); }

private:
    ClapPlugin(const clap_host_t& wanted, const clap_plugin_descriptor_t& described);

    bool init();
    bool activate(double rate, std::uint32_t mostFrames);
    void deactivate();
    clap_process_status process(const clap_process_t& block) noexcept;
    void onMainThread();

    /// What exists from init() on.
    struct Parts
    {
        explicit Parts(ClapPlugin& owner);

        Plugin processor;
        ClapAudio audio{processor};
        ParameterReports reports;
        ClapWindow window;
    };

    clap_plugin_t seen;
    const clap_host_t& host;
    std::unique_ptr<ClapEventLoop> loop; ///< ends after the parts
    std::unique_ptr<Parts> parts;
    bool active = false;
    std::atomic<bool> edited{false};
};

} // namespace pacini::plugin
