// SPDX-License-Identifier: GPL-3.0-or-later

// Describes the parameters and the window of an LV2 anew, once it is built: pacini_describe_lv2 FOLDER_OF_LV2...

#include "plugin/engine/Lv2Parameters.h"

#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

namespace
{
/// Writes a file of the LV2 anew; whether that succeeded.
template <typename Describe>
bool rewrite(const std::string& path, const Describe& describe)
{
    std::ifstream in(path, std::ios::binary);
    const std::string written{std::istreambuf_iterator<char>(in), {}};
    in.close();
    const pacini::Result<std::string> described = describe(written);
    if (!described)
    {
        std::cerr << path << ": " << described.error().text() << '\n';
        return false;
    }
    std::ofstream out(path, std::ios::binary);
    out << *described;
    if (!out.flush())
    {
        std::cerr << path << ": cannot be written\n";
        return false;
    }
    return true;
}
} // namespace

int main(int argc, char** argv)
{
    for (int i = 1; i < argc; ++i)
    {
        const std::string folder = argv[i];
        if (!rewrite(folder + "/dsp.ttl", pacini::plugin::describeLv2Parameters) ||
            !rewrite(folder + "/ui.ttl", [](const std::string& text)
                     { return pacini::Result<std::string>(pacini::plugin::describeLv2Window(text)); }))
            return 1;
    }
    return 0;
}
