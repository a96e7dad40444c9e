/* A program that keeps a file open for itself: hold.exe FILE, until its standard input ends. */
#include <stdio.h>
#include <windows.h>

int main(void)
{
    int count = 0;
    wchar_t** words = CommandLineToArgvW(GetCommandLineW(), &count);
    const HANDLE file = count == 2 ? CreateFileW(words[1], GENERIC_READ, 0, NULL, OPEN_EXISTING, 0, NULL) : NULL;
    if (file == NULL || file == INVALID_HANDLE_VALUE)
        return 1;
    puts("held");
    fflush(stdout);
    while (getchar() != EOF)
    {
    }
    CloseHandle(file);
    return 0;
}
