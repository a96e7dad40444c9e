/* A host for one LV2 plugin, offline. Samples come from and go to files of raw 32-bit floats, frame by frame: as many
   values as the plugin has audio ports of that direction, in their order.

   lv2render URI RATE BLOCK IN OUT [--set PROPERTY=VALUE]... [--port SYMBOL=VALUE]... [--get PROPERTY|all]... [--at FRAME]
             [--load STATE] [--preset URI] [--save STATE] [--latency] [--sets] [--parameters] [--silence SECONDS]

   --at gives the frame at which the block begins that brings the --set, --port and --get that follow it (0 at first); --get
   asks for a value, which --sets then prints. States are
   Turtle files. --latency prints the value of the latency port after the last block, --sets each value that the plugin
   sends: "PROPERTY VALUE", --parameters what the plugin's files say of its parameters, between tabs: property, least value,
   largest value, default, and "VALUE LABEL" of each scale point, --silence what share of a core the plugin takes while it
   plays IN, and in so many seconds of silence, 5 s after its end: "SHARE SHARE". */

#include <lilv/lilv.h>
#include <lv2/atom/atom.h>
#include <lv2/atom/forge.h>
#include <lv2/atom/util.h>
#include <lv2/buf-size/buf-size.h>
#include <lv2/core/lv2.h>
#include <lv2/options/options.h>
#include <lv2/parameters/parameters.h>
#include <lv2/patch/patch.h>
#include <lv2/urid/urid.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { mostUris = 4096, mostPorts = 128, atomBytes = 1 << 18 };

static char* knownUris[mostUris];
static uint32_t knownCount = 0;

static LV2_URID mapUri(LV2_URID_Map_Handle handle, const char* uri)
{
    (void) handle;
    for (uint32_t i = 0; i < knownCount; ++i)
        if (strcmp(knownUris[i], uri) == 0)
            return i + 1;
    if (knownCount == mostUris)
        return 0;
    knownUris[knownCount] = malloc(strlen(uri) + 1);
    strcpy(knownUris[knownCount], uri);
    return ++knownCount;
}

static const char* unmapUri(LV2_URID_Unmap_Handle handle, LV2_URID urid)
{
    (void) handle;
    return urid > 0 && urid <= knownCount ? knownUris[urid - 1] : NULL;
}

static int fail(const char* what, const char* which)
{
    fprintf(stderr, "lv2render: %s %s\n", what, which);
    return 1;
}

/* The bytes of a file and a 0 behind them. */
static char* readBytes(const char* path, size_t* count)
{
    FILE* file = fopen(path, "rb");
    if (!file)
        return NULL;
    fseek(file, 0, SEEK_END);
    *count = (size_t) ftell(file);
    rewind(file);
    char* bytes = calloc(*count + 1, 1);
    const size_t got = fread(bytes, 1, *count, file);
    fclose(file);
    return got == *count ? bytes : NULL;
}

/* A patch:Set of one property in the sequence that is being forged. */
static void forgeSet(LV2_Atom_Forge* forge, LV2_URID property, float value)
{
    LV2_Atom_Forge_Frame object;
    lv2_atom_forge_frame_time(forge, 0);
    lv2_atom_forge_object(forge, &object, 0, mapUri(NULL, LV2_PATCH__Set));
    lv2_atom_forge_key(forge, mapUri(NULL, LV2_PATCH__property));
    lv2_atom_forge_urid(forge, property);
    lv2_atom_forge_key(forge, mapUri(NULL, LV2_PATCH__value));
    lv2_atom_forge_float(forge, value);
    lv2_atom_forge_pop(forge, &object);
}

/* A patch:Get of one property, of all for 0. */
static void forgeGet(LV2_Atom_Forge* forge, LV2_URID property)
{
    LV2_Atom_Forge_Frame object;
    lv2_atom_forge_frame_time(forge, 0);
    lv2_atom_forge_object(forge, &object, 0, mapUri(NULL, LV2_PATCH__Get));
    if (property != 0)
    {
        lv2_atom_forge_key(forge, mapUri(NULL, LV2_PATCH__property));
        lv2_atom_forge_urid(forge, property);
    }
    lv2_atom_forge_pop(forge, &object);
}

/* "NAME=VALUE" in two; 0 if it is not. */
static int splitSetting(const char* setting, char* name, size_t room, float* value)
{
    const char* equals = strrchr(setting, '=');
    if (!equals || (size_t) (equals - setting) >= room)
        return 0;
    memcpy(name, setting, (size_t) (equals - setting));
    name[equals - setting] = 0;
    *value = (float) atof(equals + 1);
    return 1;
}

/* The values of patch:Set messages that the plugin sent. */
static void printSets(const LV2_Atom_Sequence* sequence)
{
    const LV2_URID setType = mapUri(NULL, LV2_PATCH__Set);
    LV2_ATOM_SEQUENCE_FOREACH(sequence, event)
    {
        const LV2_Atom_Object* object = (const LV2_Atom_Object*) &event->body;
        if (event->body.type != mapUri(NULL, LV2_ATOM__Object) || object->body.otype != setType)
            continue;
        const LV2_Atom* property = NULL;
        const LV2_Atom* value = NULL;
        lv2_atom_object_get(object, mapUri(NULL, LV2_PATCH__property), &property, mapUri(NULL, LV2_PATCH__value), &value, 0);
        if (property && value && value->type == mapUri(NULL, LV2_ATOM__Float))
            printf("%s %.9g\n", unmapUri(NULL, ((const LV2_Atom_URID*) property)->body),
                   (double) ((const LV2_Atom_Float*) value)->body);
    }
}

static void printNumber(LilvWorld* world, const LilvNode* subject, const char* property)
{
    LilvNode* predicate = lilv_new_uri(world, property);
    LilvNode* value = lilv_world_get(world, subject, predicate, NULL);
    printf("\t%.9g", value ? (double) lilv_node_as_float(value) : NAN);
    lilv_node_free(value);
    lilv_node_free(predicate);
}

static void printParameters(LilvWorld* world, const LilvPlugin* plugin)
{
    LilvNode* writable = lilv_new_uri(world, LV2_PATCH__writable);
    LilvNode* scalePoint = lilv_new_uri(world, LV2_CORE__scalePoint);
    LilvNode* value = lilv_new_uri(world, LILV_NS_RDF "value");
    LilvNode* label = lilv_new_uri(world, LILV_NS_RDFS "label");
    LilvNodes* parameters = lilv_plugin_get_value(plugin, writable);
    LILV_FOREACH(nodes, p, parameters)
    {
        const LilvNode* parameter = lilv_nodes_get(parameters, p);
        printf("%s", lilv_node_as_uri(parameter));
        printNumber(world, parameter, LV2_CORE__minimum);
        printNumber(world, parameter, LV2_CORE__maximum);
        printNumber(world, parameter, LV2_CORE__default);
        LilvNodes* points = lilv_world_find_nodes(world, parameter, scalePoint, NULL);
        LILV_FOREACH(nodes, s, points)
        {
            const LilvNode* point = lilv_nodes_get(points, s);
            LilvNode* at = lilv_world_get(world, point, value, NULL);
            LilvNode* text = lilv_world_get(world, point, label, NULL);
            printf("\t%.9g %s", at ? (double) lilv_node_as_float(at) : NAN, text ? lilv_node_as_string(text) : "");
            lilv_node_free(at);
            lilv_node_free(text);
        }
        lilv_nodes_free(points);
        printf("\n");
    }
    lilv_nodes_free(parameters);
    lilv_node_free(label);
    lilv_node_free(value);
    lilv_node_free(scalePoint);
    lilv_node_free(writable);
}

/* Seconds of processor time that this thread has taken. */
static double worked(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double) now.tv_sec + 1e-9 * (double) now.tv_nsec;
}

int main(int argc, char** argv)
{
    if (argc < 6)
        return fail("usage:", "URI RATE BLOCK IN OUT [options]");
    const char* wantedUri = argv[1];
    float rate = (float) atof(argv[2]);
    int32_t block = atoi(argv[3]);
    const char* loadPath = NULL;
    const char* savePath = NULL;
    const char* presetUri = NULL;
    int tellLatency = 0, tellSets = 0, tellParameters = 0;
    double silence = 0.0; /* s */
    for (int a = 6; a < argc; ++a)
    {
        if (strcmp(argv[a], "--load") == 0 && a + 1 < argc)
            loadPath = argv[++a];
        else if (strcmp(argv[a], "--save") == 0 && a + 1 < argc)
            savePath = argv[++a];
        else if (strcmp(argv[a], "--preset") == 0 && a + 1 < argc)
            presetUri = argv[++a];
        else if (strcmp(argv[a], "--silence") == 0 && a + 1 < argc)
            silence = atof(argv[++a]);
        else if (strcmp(argv[a], "--latency") == 0)
            tellLatency = 1;
        else if (strcmp(argv[a], "--sets") == 0)
            tellSets = 1;
        else if (strcmp(argv[a], "--parameters") == 0)
            tellParameters = 1;
        else if ((strcmp(argv[a], "--set") == 0 || strcmp(argv[a], "--port") == 0 || strcmp(argv[a], "--at") == 0 ||
                  strcmp(argv[a], "--get") == 0) &&
                 a + 1 < argc)
            ++a;
        else
            return fail("unknown option", argv[a]);
    }

    LilvWorld* world = lilv_world_new();
    lilv_world_load_all(world);
    LilvNode* uri = lilv_new_uri(world, wantedUri);
    const LilvPlugin* plugin = lilv_plugins_get_by_uri(lilv_world_get_all_plugins(world), uri);
    if (!plugin)
        return fail("no plugin", wantedUri);
    if (tellParameters)
        printParameters(world, plugin);

    LV2_URID_Map map = {NULL, mapUri};
    LV2_URID_Unmap unmap = {NULL, unmapUri};
    const int32_t least = 1;
    const LV2_URID intType = mapUri(NULL, LV2_ATOM__Int);
    const LV2_Options_Option options[] = {
        {LV2_OPTIONS_INSTANCE, 0, mapUri(NULL, LV2_PARAMETERS__sampleRate), sizeof(float), mapUri(NULL, LV2_ATOM__Float), &rate},
        {LV2_OPTIONS_INSTANCE, 0, mapUri(NULL, LV2_BUF_SIZE__minBlockLength), sizeof(int32_t), intType, &least},
        {LV2_OPTIONS_INSTANCE, 0, mapUri(NULL, LV2_BUF_SIZE__maxBlockLength), sizeof(int32_t), intType, &block},
        {LV2_OPTIONS_INSTANCE, 0, 0, 0, 0, NULL}};
    const LV2_Feature mapFeature = {LV2_URID__map, &map};
    const LV2_Feature unmapFeature = {LV2_URID__unmap, &unmap};
    const LV2_Feature optionsFeature = {LV2_OPTIONS__options, (void*) options};
    const LV2_Feature boundedFeature = {LV2_BUF_SIZE__boundedBlockLength, NULL};
    const LV2_Feature* features[] = {&mapFeature, &unmapFeature, &optionsFeature, &boundedFeature, NULL};
    LilvInstance* instance = lilv_plugin_instantiate(plugin, (double) rate, features);
    if (!instance)
        return fail("cannot instantiate", wantedUri);

    if (loadPath)
    {
        size_t length = 0;
        char* text = readBytes(loadPath, &length);
        LilvState* state = text ? lilv_state_new_from_string(world, &map, text) : NULL;
        free(text);
        if (!state)
            return fail("no state in", loadPath);
        lilv_state_restore(state, instance, NULL, NULL, 0, features);
        lilv_state_free(state);
    }
    if (presetUri)
    {
        LilvNode* preset = lilv_new_uri(world, presetUri);
        lilv_world_load_resource(world, preset);
        LilvState* state = lilv_state_new_from_world(world, &map, preset);
        if (!state)
            return fail("no preset", presetUri);
        lilv_state_restore(state, instance, NULL, NULL, 0, features);
        lilv_state_free(state);
        lilv_node_free(preset);
    }

    LilvNode* audioClass = lilv_new_uri(world, LV2_CORE__AudioPort);
    LilvNode* controlClass = lilv_new_uri(world, LV2_CORE__ControlPort);
    LilvNode* atomClass = lilv_new_uri(world, LV2_ATOM__AtomPort);
    LilvNode* inputClass = lilv_new_uri(world, LV2_CORE__InputPort);
    const uint32_t ports = lilv_plugin_get_num_ports(plugin);
    if (ports > mostPorts)
        return fail("too many ports:", wantedUri);
    float* inPorts[mostPorts];
    float* outPorts[mostPorts];
    float controls[mostPorts] = {0};
    LV2_Atom_Sequence* atomOuts[mostPorts];
    LV2_Atom_Sequence* atomIn = NULL;
    size_t ins = 0, outs = 0, atomOutCount = 0;
    uint32_t latencyPort = mostPorts;
    if (lilv_plugin_has_latency(plugin))
        latencyPort = lilv_plugin_get_latency_port_index(plugin);
    for (uint32_t p = 0; p < ports; ++p)
    {
        const LilvPort* port = lilv_plugin_get_port_by_index(plugin, p);
        const int isInput = lilv_port_is_a(plugin, port, inputClass);
        if (lilv_port_is_a(plugin, port, audioClass))
        {
            float* memory = calloc((size_t) block, sizeof(float));
            *(isInput ? &inPorts[ins++] : &outPorts[outs++]) = memory;
            lilv_instance_connect_port(instance, p, memory);
        }
        else if (lilv_port_is_a(plugin, port, controlClass))
        {
            LilvNode* standard = NULL;
            lilv_port_get_range(plugin, port, &standard, NULL, NULL);
            if (standard)
                controls[p] = lilv_node_as_float(standard);
            if (strcmp(lilv_node_as_string(lilv_port_get_symbol(plugin, port)), "freeWheeling") == 0)
                controls[p] = 1.0f; /* there is all the time in the world */
            lilv_node_free(standard);
            lilv_instance_connect_port(instance, p, &controls[p]);
        }
        else if (lilv_port_is_a(plugin, port, atomClass))
        {
            LV2_Atom_Sequence* sequence = calloc(1, atomBytes);
            if (isInput)
                atomIn = sequence;
            else
                atomOuts[atomOutCount++] = sequence;
            lilv_instance_connect_port(instance, p, sequence);
        }
        else
            return fail("a port of an unknown kind in", wantedUri);
    }

    size_t bytes = 0;
    float* in = (float*) (void*) readBytes(argv[4], &bytes); /* memory of calloc suits any type */
    FILE* out = fopen(argv[5], "wb");
    if (!in || !out)
        return fail("cannot open", in ? argv[5] : argv[4]);
    const size_t frames = bytes / sizeof(float) / (ins > 0 ? ins : 1);
    lilv_instance_activate(instance);
    LV2_Atom_Forge forge;
    lv2_atom_forge_init(&forge, &map);
    size_t done = 0;
    size_t before = 0; /* frames that were done when the block before began */
    int first = 1;
    double playing = 0.0; /* s of work */
    while (done < frames)
    {
        const size_t n = frames - done < (size_t) block ? frames - done : (size_t) block;
        for (size_t c = 0; c < ins; ++c)
            for (size_t i = 0; i < n; ++i)
                inPorts[c][i] = in[(done + i) * ins + c];
        LV2_Atom_Forge_Frame sequence;
        if (atomIn)
        {
            lv2_atom_forge_set_buffer(&forge, (uint8_t*) atomIn, atomBytes);
            lv2_atom_forge_sequence_head(&forge, &sequence, 0);
        }
        size_t at = 0;
        for (int a = 6; a + 1 < argc; ++a)
        {
            char name[512];
            float value = 0.0f;
            const int isPort = strcmp(argv[a], "--port") == 0;
            if (strcmp(argv[a], "--at") == 0)
                at = (size_t) atol(argv[++a]);
            else if (strcmp(argv[a], "--get") == 0)
            {
                ++a;
                if (at <= done && (first || at > before) && atomIn)
                    forgeGet(&forge, strcmp(argv[a], "all") == 0 ? 0 : mapUri(NULL, argv[a]));
            }
            else if (isPort || strcmp(argv[a], "--set") == 0)
            {
                const int due = at <= done && (first || at > before);
                if (!splitSetting(argv[++a], name, sizeof name, &value))
                    return fail("no setting:", argv[a]);
                if (due && isPort)
                {
                    LilvNode* symbol = lilv_new_string(world, name);
                    const LilvPort* port = lilv_plugin_get_port_by_symbol(plugin, symbol);
                    lilv_node_free(symbol);
                    if (!port)
                        return fail("no port", name);
                    controls[lilv_port_get_index(plugin, port)] = value;
                }
                else if (due && atomIn)
                    forgeSet(&forge, mapUri(NULL, name), value);
            }
        }
        if (atomIn)
            lv2_atom_forge_pop(&forge, &sequence);
        for (size_t k = 0; k < atomOutCount; ++k)
        {
            atomOuts[k]->atom.type = mapUri(NULL, LV2_ATOM__Chunk);
            atomOuts[k]->atom.size = atomBytes - sizeof(LV2_Atom);
        }
        const double begin = worked();
        lilv_instance_run(instance, (uint32_t) n);
        playing += worked() - begin;
        for (size_t k = 0; k < atomOutCount && tellSets; ++k)
            if (atomOuts[k]->atom.type == mapUri(NULL, LV2_ATOM__Sequence))
                printSets(atomOuts[k]);
        for (size_t i = 0; i < n; ++i)
            for (size_t c = 0; c < outs; ++c)
                fwrite(&outPorts[c][i], sizeof(float), 1, out);
        before = done;
        done += n;
        first = 0;
    }
    fclose(out);
    if (silence > 0.0)
    {
        const double dies = 5.0; /* s */
        double begin = 0.0, resting = 0.0;
        for (size_t c = 0; c < ins; ++c)
            memset(inPorts[c], 0, (size_t) block * sizeof(float));
        for (double played = 0.0; played < dies + silence; played += (double) block / rate)
        {
            LV2_Atom_Forge_Frame none;
            if (atomIn)
            {
                lv2_atom_forge_set_buffer(&forge, (uint8_t*) atomIn, atomBytes);
                lv2_atom_forge_sequence_head(&forge, &none, 0);
                lv2_atom_forge_pop(&forge, &none);
            }
            for (size_t k = 0; k < atomOutCount; ++k)
            {
                atomOuts[k]->atom.type = mapUri(NULL, LV2_ATOM__Chunk);
                atomOuts[k]->atom.size = atomBytes - sizeof(LV2_Atom);
            }
            begin = worked();
            lilv_instance_run(instance, (uint32_t) block);
            resting += played < dies ? 0.0 : worked() - begin;
        }
        printf("%g %g\n", playing * rate / (double) frames, resting / silence);
    }
    if (tellLatency && latencyPort < mostPorts)
        printf("%d\n", (int) controls[latencyPort]);
    if (savePath)
    {
        LilvState* state = lilv_state_new_from_instance(plugin, instance, &map, NULL, NULL, NULL, NULL, NULL, NULL, 0, features);
        char* text = state ? lilv_state_to_string(world, &map, &unmap, state, "urn:lv2render:state", NULL) : NULL;
        FILE* file = text ? fopen(savePath, "w") : NULL;
        if (!file)
            return fail("cannot save the state to", savePath);
        fputs(text, file);
        fclose(file);
        lilv_free(text);
        lilv_state_free(state);
    }
    fprintf(stderr, "lv2render: %zu frames, %zu in, %zu out\n", frames, ins, outs);
    lilv_instance_deactivate(instance);
    lilv_instance_free(instance);
    lilv_world_free(world);
    return 0;
}
