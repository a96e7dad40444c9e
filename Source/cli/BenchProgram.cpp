#include "cli/BenchProgram.h"

#include "cli/ProgramFolder.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
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
    const std::filesystem::path program = programFolder() / "pacini-bench";
    std::vector<std::string> arguments = words;
    arguments.front() = program.string();
    if (const auto command = std::find(arguments.begin(), arguments.end(), "bench"); command != arguments.end())
        arguments.erase(command);
#if defined(_WIN32)
    std::vector<std::wstring> quoted; // one line for the program, which divides it
    for (const std::string& word : arguments)
        quoted.push_back(L'"' + std::filesystem::path(word).native() + (word.ends_with('\\') ? L"\\\"" : L"\""));
    std::vector<const wchar_t*> line;
    for (const std::wstring& word : quoted)
        line.push_back(word.c_str());
    line.push_back(nullptr);
    if (const std::intptr_t exit = _wspawnv(_P_WAIT, (program.native() + L".exe").c_str(), line.data()); exit >= 0)
        std::exit(static_cast<int>(exit)); // it has reported
#else
    std::vector<char*> line;
    for (std::string& word : arguments)
        line.push_back(word.data());
    line.push_back(nullptr);
    execv(program.c_str(), line.data());
#endif
    return console.fail(program.string(), {ErrorCode::io, "",
                                           std::string("cannot be started: ") + std::strerror(errno) +
                                               "; build the target pacini-bench, which puts it beside pacini"});
}

} // namespace pacini::cli
