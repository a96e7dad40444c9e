/* Stands for a plugin that reads a sound, and for the host that loads it from another folder.

   As a library (-DPLUGIN): frames() of a file, or -1 with why on stderr.
   As a program: reads_sound LIBRARY FILE prints the frames. */

#include <stdio.h>
#include <windows.h>

#ifdef PLUGIN
#include <sndfile.h>

__declspec(dllexport) long long frames(const char* path)
{
    SF_INFO info = {0};
    SNDFILE* file = sf_open(path, SFM_READ, &info);
    if (!file)
    {
        fprintf(stderr, "%s\n", sf_strerror(NULL));
        return -1;
    }
    sf_close(file);
    return info.frames;
}
#else
int main(int argc, char** argv)
{
    HMODULE library = argc == 3 ? LoadLibraryA(argv[1]) : NULL;
    if (!library)
        return 2;
    long long (*frames)(const char*) = (long long (*)(const char*))(void*)GetProcAddress(library, "frames");
    const long long found = frames(argv[2]);
    printf("%lld\n", found);
    return found < 0;
}
#endif
