/* Plays a file into another client of JACK and writes what that plays, while the server runs freely, so that nothing is
   dropped however busy the machine is. Samples are raw 32-bit floats, frame by frame.

   jackrender IN OUT INPUT_PORT... -- OUTPUT_PORT...

   IN has as many channels as there are input ports, OUT as many as output ports, and as many frames as IN. */

#include <jack/jack.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { most = 16 };

static jack_port_t *to[most], *from[most];
static size_t toCount = 0, fromCount = 0, frames = 0, position = 0;
static float *in, *out;
static atomic_int isFree, done;

static void freewheel(int starting, void* unused)
{
    (void) unused;
    atomic_store(&isFree, starting);
}

static int process(jack_nframes_t n, void* unused)
{
    (void) unused;
    const int plays = atomic_load(&isFree);
    for (size_t c = 0; c < toCount; ++c)
    {
        float* samples = jack_port_get_buffer(to[c], n);
        for (size_t i = 0; i < n; ++i)
            samples[i] = plays && position + i < frames ? in[(position + i) * toCount + c] : 0.0f;
    }
    for (size_t c = 0; plays && c < fromCount; ++c)
    {
        const float* samples = jack_port_get_buffer(from[c], n);
        for (size_t i = 0; i < n && position + i < frames; ++i)
            out[(position + i) * fromCount + c] = samples[i];
    }
    if (plays)
        position += n;
    if (position >= frames)
        atomic_store(&done, 1);
    return 0;
}

static int fail(const char* what, const char* which)
{
    fprintf(stderr, "jackrender: %s %s\n", what, which);
    return 1;
}

int main(int count, char** words)
{
    if (count < 5)
        return fail("needs", "IN OUT INPUT_PORT... -- OUTPUT_PORT...");
    const char *inputs[most], *outputs[most];
    int outputsFollow = 0;
    for (int i = 3; i < count; ++i)
        if (strcmp(words[i], "--") == 0)
            outputsFollow = 1;
        else if (outputsFollow && fromCount < most)
            outputs[fromCount++] = words[i];
        else if (toCount < most)
            inputs[toCount++] = words[i];
    if (toCount == 0 || fromCount == 0)
        return fail("needs ports", "of both directions");

    FILE* file = fopen(words[1], "rb");
    if (!file || fseek(file, 0, SEEK_END) != 0)
        return fail("cannot read", words[1]);
    frames = (size_t) ftell(file) / (toCount * sizeof(float));
    rewind(file);
    in = malloc(frames * toCount * sizeof(float));
    out = calloc(frames * fromCount, sizeof(float));
    if (!in || !out || fread(in, toCount * sizeof(float), frames, file) != frames)
        return fail("cannot read", words[1]);
    fclose(file);

    jack_client_t* client = jack_client_open("jackrender", JackNoStartServer, NULL);
    if (!client)
        return fail("finds no", "sound server");
    char name[32];
    for (size_t c = 0; c < toCount; ++c)
    {
        snprintf(name, sizeof name, "to_%zu", c + 1);
        to[c] = jack_port_register(client, name, JACK_DEFAULT_AUDIO_TYPE, JackPortIsOutput, 0);
    }
    for (size_t c = 0; c < fromCount; ++c)
    {
        snprintf(name, sizeof name, "from_%zu", c + 1);
        from[c] = jack_port_register(client, name, JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0);
    }
    jack_set_process_callback(client, process, NULL);
    jack_set_freewheel_callback(client, freewheel, NULL);
    if (jack_activate(client) != 0)
        return fail("is not", "activated");
    for (size_t c = 0; c < toCount; ++c)
        if (jack_connect(client, jack_port_name(to[c]), inputs[c]) != 0)
            return fail("cannot connect", inputs[c]);
    for (size_t c = 0; c < fromCount; ++c)
        if (jack_connect(client, outputs[c], jack_port_name(from[c])) != 0)
            return fail("cannot connect", outputs[c]);
    jack_set_freewheel(client, 1);
    for (int i = 0; i < 6000 && !atomic_load(&done); ++i)
        usleep(10000);
    jack_set_freewheel(client, 0);
    usleep(200000);
    jack_client_close(client);
    if (!atomic_load(&done))
        return fail("played", "not all in a minute");
    file = fopen(words[2], "wb");
    if (!file || fwrite(out, fromCount * sizeof(float), frames, file) != frames || fclose(file) != 0)
        return fail("cannot write", words[2]);
    return 0;
}
