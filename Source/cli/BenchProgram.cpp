#include "cli/BenchProgram.h"

#include "cli/ProgramFolder.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>

#if defined(_WIN32)
#include <process.h>
#else
#include <unistd.h>
#endif

namespace pacini::cli
{

Exit runBenchProgram(const std::vector<std::string>& words, Console& console)
{
    const std::string program = (programFolder() / "pacini-bench").string();
    std::vector<std::string> arguments = words;
    arguments.front() = program;
    if (const auto command = std::find(arguments.begin(), arguments.end(), "bench"); command != arguments.end())
        arguments.erase(command);
    std::vector<char*> line;
    for (std::string& word : arguments)
    {
#if defined(_WIN32)
        word = '"' + word + (word.ends_with('\\') ? "\\\"" : "\""); // one line for the program, which divides it
#endif
        line.push_back(word.data());
    }
    line.push_back(nullptr);
#if defined(_WIN32)
    if (const std::intptr_t exit = _spawnv(_P_WAIT, (program + ".exe").c_str(), line.data()); exit >= 0)
        return static_cast<Exit>(exit);
#else
    execv(program.c_str(), line.data());
#endif
    return console.fail(program, {ErrorCode::io, "",
                                  std::string("cannot be started: ") + std::strerror(errno) +
                                      "; build the target pacini-bench, which puts it beside pacini"});
}

} // namespace pacini::cli
