// Tells mutate.py which tests reach which changes: a line for each test case that passes, with its seconds, the numbers
// of the changes and its name, in the file that the environment variable PACINI_MUTANTS_REACHED names.

#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include "support/Catch.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>

namespace
{
class Reached : public Catch::TestEventListenerBase
{
public:
    using TestEventListenerBase::TestEventListenerBase;

    void testRunStarting(const Catch::TestRunInfo& run) override
    {
        TestEventListenerBase::testRunStarting(run);
        if (const char* path = std::getenv("PACINI_MUTANTS_REACHED"))
            file_.open(path);
        write(0.0, "(before the first test)");
    }

    void testCaseStarting(const Catch::TestCaseInfo& test) override
    {
        TestEventListenerBase::testCaseStarting(test);
        for (auto& reached : mutants::reached)
            reached = false;
        started_ = std::chrono::steady_clock::now();
    }

    void testCaseEnded(const Catch::TestCaseStats& test) override
    {
        TestEventListenerBase::testCaseEnded(test);
        if (test.totals.testCases.failed == 0)
            write(std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count(),
                  test.testInfo.name);
    }

private:
    void write(double seconds, const std::string& name)
    {
        if (!file_.is_open())
            return;
        file_ << seconds << '\t';
        for (int i = 0; i < mutants::most; ++i)
            if (mutants::reached[i])
                file_ << i << ' ';
        file_ << '\t' << name << std::endl;
    }

    std::ofstream file_;
    std::chrono::steady_clock::time_point started_;
};
} // namespace

CATCH_REGISTER_LISTENER(Reached)
