// Embree beside our own tree: the same mesh, the same rays, in the same run. `benches/rays.rs` builds and starts this
// program, and reads one line from it:
//
//     embree LIBRARY FILE CONFIG FLAGS  ->  build_s bytes  camera_Mrays_s hits  bounce ..  shadow ..  anywhere ..
//
// FILE holds little-endian words: counts of vertices, triangles and of each set of rays; positions; indices; rays of six
// floats. The library is loaded by name, and the few declarations needed stand here, so no headers are asked for.
// Seconds are those of this thread alone, the best of several runs, and include the filling of the ray's record.
#include <dlfcn.h>
#include <pmmintrin.h>
#include <sys/types.h>
#include <time.h>
#include <xmmintrin.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

// RTCRayHit of Embree 4, without levels of instances beyond one.
struct alignas(16) RayHit {
    float o[3], tnear, d[3], time, tfar;
    unsigned mask, id, flags;
    float n[3], u, v;
    unsigned prim, geom, inst, inst_prim, unused[8];
};

struct Ray {
    float o[3], d[3];
};

enum { FORMAT_UINT3 = 0x5003, FORMAT_FLOAT3 = 0x9003, TYPE_TRIANGLE = 0, BUFFER_INDEX = 0, BUFFER_VERTEX = 1, QUALITY_HIGH = 2 };

static long bytes_in_use = 0;

static bool count_bytes(void*, ssize_t bytes, bool) {
    bytes_in_use += bytes;
    return true;
}

static double thread_seconds() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

static void fail(const char* what) {
    fprintf(stderr, "embree: %s\n", what);
    exit(1);
}

template <class T>
static std::vector<T> read(FILE* file, size_t count) {
    std::vector<T> items(count);
    if (fread(items.data(), sizeof(T), count, file) != count) fail("the file ends early");
    return items;
}

int main(int argc, char** argv) {
    if (argc != 5) fail("embree LIBRARY FILE CONFIG FLAGS");
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    void* library = dlopen(argv[1], RTLD_NOW);
    if (!library) fail(dlerror());
    auto symbol = [&](const char* name) {
        void* found = dlsym(library, name);
        if (!found) fail(name);
        return found;
    };
    auto new_device = (void* (*)(const char*))symbol("rtcNewDevice");
    auto monitor = (void (*)(void*, bool (*)(void*, ssize_t, bool), void*))symbol("rtcSetDeviceMemoryMonitorFunction");
    auto new_scene = (void* (*)(void*))symbol("rtcNewScene");
    auto set_quality = (void (*)(void*, int))symbol("rtcSetSceneBuildQuality");
    auto set_flags = (void (*)(void*, int))symbol("rtcSetSceneFlags");
    auto new_geometry = (void* (*)(void*, int))symbol("rtcNewGeometry");
    auto share_buffer = (void (*)(void*, int, unsigned, int, const void*, size_t, size_t, size_t))symbol("rtcSetSharedGeometryBuffer");
    auto commit_geometry = (void (*)(void*))symbol("rtcCommitGeometry");
    auto attach = (unsigned (*)(void*, void*))symbol("rtcAttachGeometry");
    auto commit_scene = (void (*)(void*))symbol("rtcCommitScene");
    auto intersect = (void (*)(void*, void*, void*))symbol("rtcIntersect1");
    auto occluded = (void (*)(void*, void*, void*))symbol("rtcOccluded1");

    FILE* file = fopen(argv[2], "rb");
    if (!file) fail("the file cannot be opened");
    auto counts = read<uint32_t>(file, 6);
    auto positions = read<float>(file, 3 * size_t(counts[0]) + 1); // padded: Embree loads 16 bytes a vertex
    auto indices = read<uint32_t>(file, 3 * size_t(counts[1]));
    std::vector<Ray> rays[4];
    for (int set = 0; set < 4; set++) rays[set] = read<Ray>(file, counts[2 + set]);

    // Build on one thread, at the quality that splits space too.
    void* device = new_device(argv[3]);
    monitor(device, count_bytes, nullptr);
    void* scene = new_scene(device);
    set_quality(scene, QUALITY_HIGH);
    set_flags(scene, atoi(argv[4]));
    void* geometry = new_geometry(device, TYPE_TRIANGLE);
    share_buffer(geometry, BUFFER_VERTEX, 0, FORMAT_FLOAT3, positions.data(), 0, 12, counts[0]);
    share_buffer(geometry, BUFFER_INDEX, 0, FORMAT_UINT3, indices.data(), 0, 12, counts[1]);
    double start = thread_seconds();
    commit_geometry(geometry);
    attach(scene, geometry);
    commit_scene(scene);
    printf("%.4f %ld", thread_seconds() - start, bytes_in_use);

    auto fill = [](RayHit& record, const Ray& ray) {
        for (int k = 0; k < 3; k++) record.o[k] = ray.o[k], record.d[k] = ray.d[k];
        record.tnear = 0;
        record.tfar = INFINITY;
        record.time = 0;
        record.mask = ~0u;
        record.id = record.flags = 0;
        record.geom = record.inst = record.inst_prim = ~0u;
    };
    const int closest[4] = {1, 1, 0, 1};
    for (int set = 0; set < 4; set++) {
        double best = INFINITY;
        size_t hits = 0;
        RayHit record = {};
        for (int run = 0; run < 5; run++) {
            hits = 0;
            double start = thread_seconds();
            for (const Ray& ray : rays[set]) {
                fill(record, ray);
                if (closest[set]) {
                    intersect(scene, &record, nullptr);
                    hits += record.geom != ~0u;
                } else {
                    occluded(scene, &record, nullptr);
                    hits += record.tfar < 0;
                }
            }
            best = fmin(best, thread_seconds() - start);
        }
        printf(" %.3f %zu", double(rays[set].size()) / best * 1e-6, hits);
    }
    printf("\n");
}
