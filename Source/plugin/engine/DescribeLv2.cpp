// SPDX-License-Identifier: GPL-3.0-or-later

// Describes the parameters of an LV2 anew, once it is built: pacini_describe_lv2 DSP.TTL...

#include "plugin/engine/Lv2Parameters.h"

#include <fstream>
#include <iostream>
#include <iterator>

int main(int argc, char** argv)
{
    for (int i = 1; i < argc; ++i)
    {
        std::ifstream in(argv[i], std::ios::binary);
        const std::string written{std::istreambuf_iterator<char>(in), {}};
        in.close();
        const auto described = pacini::plugin::describeLv2Parameters(written);
        if (!described)
        {
            std::cerr << argv[i] << ": " << described.error().text() << '\n';
            return 1;
        }
        std::ofstream out(argv[i], std::ios::binary);
        out << *described;
        if (!out.flush())
        {
            std::cerr << argv[i] << ": cannot be written\n";
            return 1;
        }
    }
    return 0;
}
