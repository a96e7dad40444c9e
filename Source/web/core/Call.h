#pragma once

// Calls from JavaScript: a name, options as JSON and buffers in; a value as JSON and buffers out.

#include "io/FieldsReader.h"
#include "io/ReadWarnings.h"

#include <pacini/actuator/Profile.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::web
{

using Json = nlohmann::ordered_json;

/// Receives the next interleaved samples of a call's sound from JavaScript; returns the number of frames.
using Pull = std::function<std::size_t(std::span<float>)>;

/// One call while it is worked on.
class Call
{
public:
    Call(const nlohmann::json& options, std::vector<std::span<const std::byte>> inputs, Pull pull)
        : reader(options, &doubts), pullSound(std::move(pull)), given(std::move(inputs))
    {
    }

    ReadWarnings doubts{true}; ///< strict: options that are not known are errors, see finishOptions()
    FieldsReader reader;       ///< of the options
    Pull pullSound;
    Json value; ///< results of the call
    std::vector<std::vector<std::byte>> outputs;

    [[nodiscard]] std::size_t inputs() const noexcept { return given.size(); }
    [[nodiscard]] std::string_view text(std::size_t input) const;
    [[nodiscard]] std::span<const float> samples(std::size_t input) const;

    void put(std::string_view bytes);
    void put(std::span<const float> samples);

    /// Returns a number of the options, within a range.
    [[nodiscard]] double number(const char* name, double usual, double low, double high);
    [[nodiscard]] std::optional<double> optionalNumber(const char* name, double low, double high);
    [[nodiscard]] bool truth(const char* name, bool usual);
    [[nodiscard]] std::string word(const char* name, std::string_view usual);

    /// Call this after all options have been read. Returns the error of an option, or an unknown option.
    [[nodiscard]] Result<void> finishOptions();

private:
    std::vector<std::span<const std::byte>> given;
};

/// Runs a call. Errors of its options are in the reader.
using Handler = Result<void> (*)(Call& call);

struct NamedHandler
{
    std::string_view name;
    Handler handler;
};

/// The calls of a module. Each module defines its own (folder `modules`), so that it contains only these.
[[nodiscard]] std::span<const NamedHandler> handlers();

[[nodiscard]] Result<void> encodeSound(Call& call);
[[nodiscard]] Result<void> translateSound(Call& call);
[[nodiscard]] Result<void> tellDefaults(Call& call);
[[nodiscard]] Result<void> describeParameters(Call& call);
[[nodiscard]] Result<void> readLive(Call& call);
[[nodiscard]] Result<void> describeLive(Call& call);
[[nodiscard]] Result<void> readClipBytes(Call& call);
[[nodiscard]] Result<void> writeClipBytes(Call& call);
[[nodiscard]] Result<void> listFormats(Call& call);
[[nodiscard]] Result<void> renderClipOrScene(Call& call);
[[nodiscard]] Result<void> compareSounds(Call& call);
[[nodiscard]] Result<void> describeExports(Call& call);
[[nodiscard]] Result<void> describeProfile(Call& call);
[[nodiscard]] Result<void> lintClip(Call& call);
[[nodiscard]] Result<void> reapplyEdits(Call& call);
[[nodiscard]] Result<void> listReports(Call& call);
[[nodiscard]] Result<void> planRumble(Call& call);
[[nodiscard]] Result<void> planTouch(Call& call);
[[nodiscard]] Result<void> drawSpectrogram(Call& call);

/// Reads the clip in a call's input, of any format; `extension` (with dot) distinguishes formats without a mark.
[[nodiscard]] Result<Clip> clipOf(const Call& call, std::size_t input, std::string_view extension = {});

/// The profile in an input, which is JSON.
[[nodiscard]] Result<Profile> profileOf(const Call& call, std::size_t input);

} // namespace pacini::web
