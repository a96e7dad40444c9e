#pragma once

// Names of a sweep's description file and of its options.

#include <filesystem>
#include <string>

namespace pacini::cli
{

/// The description that belongs to the sound of a sweep: the same name as `.json`.
[[nodiscard]] inline std::filesystem::path sweepFileBeside(std::filesystem::path sound)
{
    return sound.replace_extension(".json");
}

/// The option of `pacini measure` that sets the parameter at `path`, such as `--low` for `sweep.lowFrequency`; the path
/// itself when there is none.
[[nodiscard]] inline std::string optionFor(std::string path)
{
    for (const std::string prefix : {"sweep.", "measurement."})
        if (path.starts_with(prefix))
            path.erase(0, prefix.size());
    const auto is = [&](const char* name)
    {
        return path.starts_with(name);
    };
    return is("lowFrequency")    ? "--low"
           : is("highFrequency") ? "--high"
           : is("fullScale")     ? "--full-scale"
           : is("sampleRate")    ? "--rate"
           : is("duration") || is("levels") || is("repeats") || is("pause") || is("smoothing") || is("points")
               ? "--" + path
               : path;
}

} // namespace pacini::cli
