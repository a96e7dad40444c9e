/* A cable that is too long: a client of JACK whose output is its input some frames ago.
 *
 * jackdelay FRAMES    until it is ended
 */
#include <jack/jack.h>

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static jack_port_t *in, *out;
static float *line;
static unsigned length, next;

static int process(jack_nframes_t frames, void *unused)
{
    const float *from = jack_port_get_buffer(in, frames);
    float *to = jack_port_get_buffer(out, frames);
    (void)unused;
    for (jack_nframes_t n = 0; n < frames; ++n) {
        const float oldest = line[next];
        line[next] = from[n];
        next = (next + 1) % length;
        to[n] = oldest;
    }
    return 0;
}

int main(int count, char **arguments)
{
    jack_client_t *client;
    if (count != 2 || atoi(arguments[1]) < 1)
        return 2;
    length = (unsigned)atoi(arguments[1]);
    line = calloc(length, sizeof *line);
    client = line == NULL ? NULL : jack_client_open("delay", JackNoStartServer, NULL);
    if (client == NULL)
        return 1;
    jack_set_process_callback(client, process, NULL);
    in = jack_port_register(client, "in", JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0);
    out = jack_port_register(client, "out", JACK_DEFAULT_AUDIO_TYPE, JackPortIsOutput, 0);
    if (in == NULL || out == NULL || jack_activate(client) != 0)
        return 1;
    for (;;)
        sleep(1000);
}
