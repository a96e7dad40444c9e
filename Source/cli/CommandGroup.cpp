#include "cli/CommandGroup.h"

#include <utility>

namespace pacini::cli
{

namespace
{
class CommandGroup : public Command
{
public:
    CommandGroup(std::string named, std::string described, std::vector<std::unique_ptr<Command> (*)()> made,
                 std::string closing)
        : name(std::move(named)), description(std::move(described)), makers(std::move(made)), footer(std::move(closing))
    {
    }

    CLI::App* declare(CLI::App& app) override
    {
        auto* command = app.add_subcommand(name, description);
        command->require_subcommand(1);
        for (const auto make : makers)
        {
            auto step = make();
            auto* declared = step->declare(*command);
            steps.emplace_back(std::move(step), declared);
        }
        return command->footer(footer);
    }

    Exit run(Console& console) override
    {
        for (const auto& [step, declared] : steps)
            if (declared->parsed())
                return step->run(console);
        return Exit::usage;
    }

private:
    std::string name, description;
    std::vector<std::unique_ptr<Command> (*)()> makers;
    std::string footer;
    std::vector<std::pair<std::unique_ptr<Command>, CLI::App*>> steps;
};
} // namespace

std::unique_ptr<Command> commandGroup(std::string name, std::string description,
                                      std::vector<std::unique_ptr<Command> (*)()> steps, std::string footer)
{
    return std::make_unique<CommandGroup>(std::move(name), std::move(description), std::move(steps), std::move(footer));
}

} // namespace pacini::cli
