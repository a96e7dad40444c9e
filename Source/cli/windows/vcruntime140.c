/* VCRUNTIME140.dll for libsndfile, which is compiled by Visual C++: not every Windows has it. All but this is the system's
   own, see the .def. */
void __std_type_info_destroy_list(void* list)
{
    (void)list; /* names that typeid has made: C++ alone makes any */
}

int DllMainCRTStartup(void* instance, unsigned reason, void* reserved)
{
    (void)instance, (void)reason, (void)reserved;
    return 1;
}
