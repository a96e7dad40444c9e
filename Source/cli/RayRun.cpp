#include "cli/RayRun.h"

#include <cerrno>
#include <cstring>

#if !defined(_WIN32)
#include <unistd.h>
#endif

namespace pacini::cli
{

namespace
{
constexpr const char* program = R"(import sys
try:
    import ray
    from pacini.ray import main
except ImportError as error:
    sys.exit(f"pacini: --ray: {error}; it needs Pacini's package for Python: pip install 'pacini[ray]'")
sys.exit(main(sys.argv[1:]))
)";
} // namespace

Error runOnRay(const std::vector<std::string>& arguments)
{
#if defined(_WIN32)
    static_cast<void>(arguments);
    static_cast<void>(program);
    return {ErrorCode::invalidArgument, "--ray", "is not available on Windows; run 'python -m pacini.ray'"};
#else
    std::vector<std::string> words{"python3", "-c", program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> line;
    for (std::string& word : words)
        line.push_back(word.data());
    line.push_back(nullptr);
    execvp(line.front(), line.data());
    return {ErrorCode::io, "python3", std::string("cannot be started: ") + std::strerror(errno)};
#endif
}

} // namespace pacini::cli
