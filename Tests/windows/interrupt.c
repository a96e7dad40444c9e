/* Starts a command in a console and stops it: interrupt.exe COMMAND LINE, by Ctrl+C once a line comes on standard
   input, or by ending it at once if that line is "end". Its exit code is the command's. */
#include <stdio.h>
#include <string.h>
#include <windows.h>

int main(int argc, char** argv)
{
    STARTUPINFOA start = {sizeof start};
    PROCESS_INFORMATION command;
    char line[16] = "";
    DWORD code = 255;
    FreeConsole();
    if (argc != 2 || !AllocConsole() ||
        !CreateProcessA(NULL, argv[1], NULL, NULL, FALSE, 0, NULL, NULL, &start, &command))
        return 254;
    fgets(line, sizeof line, stdin);
    SetConsoleCtrlHandler(NULL, TRUE); /* it is for the command alone */
    if (strncmp(line, "end", 3) == 0)
        TerminateProcess(command.hProcess, 9);
    else if (!GenerateConsoleCtrlEvent(CTRL_C_EVENT, 0))
        return 253;
    WaitForSingleObject(command.hProcess, 60000);
    GetExitCodeProcess(command.hProcess, &code);
    return (int)code;
}
