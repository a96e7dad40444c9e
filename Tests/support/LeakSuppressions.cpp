// Leaks of third-party libraries that the leak sanitizer must not blame on us. Without the sanitizer nobody calls this.

extern "C" const char* __lsan_default_suppressions(); // NOLINT(bugprone-reserved-identifier)

extern "C" const char* __lsan_default_suppressions() // NOLINT(bugprone-reserved-identifier)
{
    // libsndfile 1.2 forgets a vorbis_info (6 kB) when it refuses a damaged Ogg file. fontconfig keeps what it read of
    // its configuration (1 kB) until the program ends. rtaudio_destroy() of RtAudio 5.2 frees what its handle points
    // to, not the handle (544 bytes).
    return "leak:vorbis_info_init\n"
           "leak:libfontconfig\n"
           "leak:rtaudio_create\n";
}

extern "C" const char* __lsan_default_options(); // NOLINT(bugprone-reserved-identifier)

extern "C" const char* __lsan_default_options() // NOLINT(bugprone-reserved-identifier)
{
    return "print_suppressions=0"; // what is suppressed has no place in the output of the program under test
}
