/* Stands in for the ALSA sequencer, which machines without a sound system have not: it opens, takes everything and
   brings nothing. To be preloaded into programs that do not start without one. */
#include <errno.h>

static int opened;

int snd_seq_open(void** handle, const char* name, int streams, int mode)
{
    (void)name, (void)streams, (void)mode;
    *handle = &opened;
    return 0;
}

#define DOES_NOTHING(name)                                                                                             \
    int name(void)                                                                                                     \
    {                                                                                                                  \
        return 0;                                                                                                      \
    }
#define HAS_NONE(name)                                                                                                 \
    int name(void)                                                                                                     \
    {                                                                                                                  \
        return -ENOENT;                                                                                                \
    }
#define BRINGS_NOTHING(name)                                                                                           \
    int name(void)                                                                                                     \
    {                                                                                                                  \
        return -EAGAIN;                                                                                                \
    }

DOES_NOTHING(snd_seq_close)
int snd_seq_client_id(void)
{
    return 128;
}
DOES_NOTHING(snd_seq_set_client_name)
DOES_NOTHING(snd_seq_alloc_queue)
DOES_NOTHING(snd_seq_free_queue)
DOES_NOTHING(snd_seq_create_simple_port)
DOES_NOTHING(snd_seq_delete_simple_port)
DOES_NOTHING(snd_seq_control_queue)
DOES_NOTHING(snd_seq_drain_output)
DOES_NOTHING(snd_seq_drop_input)
DOES_NOTHING(snd_seq_drop_output)
BRINGS_NOTHING(snd_seq_event_input)
DOES_NOTHING(snd_seq_event_input_pending)
DOES_NOTHING(snd_seq_event_output)
DOES_NOTHING(snd_seq_event_output_direct)
DOES_NOTHING(snd_seq_free_event)
HAS_NONE(snd_seq_get_any_client_info)
HAS_NONE(snd_seq_get_any_port_info)
DOES_NOTHING(snd_seq_get_port_info)
DOES_NOTHING(snd_seq_set_port_info)
DOES_NOTHING(snd_seq_get_queue_status)
DOES_NOTHING(snd_seq_get_queue_tempo)
DOES_NOTHING(snd_seq_set_queue_tempo)
DOES_NOTHING(snd_seq_set_queue_timer)
DOES_NOTHING(snd_seq_poll_descriptors)
DOES_NOTHING(snd_seq_poll_descriptors_count)
HAS_NONE(snd_seq_query_next_client)
HAS_NONE(snd_seq_query_next_port)
HAS_NONE(snd_seq_query_port_subscribers)
DOES_NOTHING(snd_seq_remove_events)
DOES_NOTHING(snd_seq_subscribe_port)
DOES_NOTHING(snd_seq_unsubscribe_port)
