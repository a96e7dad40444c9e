/* dxgi.dll for programs in wine, whose own never says that a screen is ready for the next picture: JUCE's windows would
   stay as they were first drawn. It is wine's, with a screen that is ready 60 times a second. */

#define COBJMACROS
#include <dxgi.h>

static HRESULT STDMETHODCALLTYPE wait_for_next_picture(IDXGIOutput* output)
{
    (void)output;
    Sleep(16);
    return S_OK;
}

__declspec(dllexport) HRESULT WINAPI CreateDXGIFactory(REFIID kind, void** factory)
{
    HMODULE own = LoadLibraryA("C:\\windows\\system32\\dxgi.dll");
    HRESULT(WINAPI * make)
    (REFIID, void**) = own ? (HRESULT(WINAPI*)(REFIID, void**))(void*)GetProcAddress(own, "CreateDXGIFactory") : NULL;
    const HRESULT made = make ? make(kind, factory) : E_FAIL;
    IDXGIAdapter* adapter;
    IDXGIOutput* output;
    if (SUCCEEDED(made) && SUCCEEDED(IDXGIFactory_EnumAdapters((IDXGIFactory*)*factory, 0, &adapter)))
    {
        if (SUCCEEDED(IDXGIAdapter_EnumOutputs(adapter, 0, &output)))
        {
            /* All outputs share this table. */
            void* entry = (void*)&output->lpVtbl->WaitForVBlank;
            DWORD before;
            VirtualProtect(entry, sizeof(void*), PAGE_READWRITE, &before);
            *(void**)entry = (void*)wait_for_next_picture;
            IDXGIOutput_Release(output);
        }
        IDXGIAdapter_Release(adapter);
    }
    return made;
}
