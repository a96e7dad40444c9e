#pragma once

// Reads the golden vectors of Tests/golden (made by an independent SciPy reference).

#include "support/Paths.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <stdexcept>
#include <string>

namespace pacini::test
{

inline nlohmann::json golden(const std::string& name)
{
    const std::string path = (testFolder() / "golden" / (name + ".json")).string();
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error("missing golden file " + path);
    return nlohmann::json::parse(file);
}

} // namespace pacini::test
