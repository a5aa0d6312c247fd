// How long Embree takes for what splats are the other way to draw: the nearest oriented disc of each pixel, by rays, without blending and without a
// filter. Beside surfel on the same splats and the same camera; no part of the program. Build and run: benches/embree/run.
//
//   discs SPLATS.ply WIDTHxHEIGHT FRAMES EX,EY,EZ TX,TY,TZ FOV_DEG [PICTURE.pgm]
//
// Reads what `surfel convert` writes of disks (binary, x y z nx ny nz radius first). Rays go in packets of 8, which are coherent, in tiles of 8 by 8
// pixels, which all cores take one after the other.
#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

struct Vec { float x, y, z; };
static Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
static Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
static Vec operator*(float s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
static float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static Vec unit(Vec a) { return (1 / std::sqrt(dot(a, a))) * a; }
static Vec parsed(const char* text) {
    Vec v{};
    if (std::sscanf(text, "%f,%f,%f", &v.x, &v.y, &v.z) != 3) { std::fprintf(stderr, "%s: expected X,Y,Z\n", text); std::exit(1); }
    return v;
}
static double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int main(int count, char** words) {
    unsigned width, height;
    if (count < 7 || std::sscanf(words[2], "%ux%u", &width, &height) != 2) {
        std::fprintf(stderr, "usage: discs SPLATS.ply WIDTHxHEIGHT FRAMES EYE TARGET FOV_DEG [PICTURE.pgm]\n");
        return 1;
    }
    std::ifstream file(words[1], std::ios::binary);
    size_t splats = 0;
    std::string line, names;
    while (std::getline(file, line) && line != "end_header") {
        std::sscanf(line.c_str(), "element vertex %zu", &splats);
        if (line.rfind("property float ", 0) == 0) names += line.substr(15) + " ";
    }
    std::vector<float> rows(7 * splats);
    file.read(reinterpret_cast<char*>(rows.data()), rows.size() * sizeof(float));
    if (names != "x y z nx ny nz radius " || splats == 0 || !file) {
        std::fprintf(stderr, "%s: expected disks of one color, as `surfel convert --resample` writes them\n", words[1]);
        return 1;
    }

    const double begun = seconds();
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    RTCGeometry discs = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    auto* places = static_cast<float*>(rtcSetNewGeometryBuffer(discs, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, splats));
    auto* normals = static_cast<float*>(rtcSetNewGeometryBuffer(discs, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, 12, splats));
    for (size_t i = 0; i < splats; ++i) {
        const float* row = &rows[7 * i];
        std::memcpy(places + 4 * i, row, 12);
        places[4 * i + 3] = row[6];
        std::memcpy(normals + 3 * i, row + 3, 12);
    }
    rtcCommitGeometry(discs);
    rtcAttachGeometry(scene, discs);
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) { std::fprintf(stderr, "Embree could not build the scene\n"); return 1; }
    const double built = seconds() - begun;

    const Vec eye = parsed(words[4]), forward = unit(parsed(words[5]) - eye);
    const Vec right = unit(cross(forward, {0, 1, 0})), down = cross(forward, right);
    const float pixel = 2 * std::tan(0.5f * std::strtof(words[6], nullptr) * 3.14159265f / 180) / height;
    std::vector<unsigned char> picture(size_t(width) * height);
    const unsigned columns = (width + 7) / 8, tiles = columns * ((height + 7) / 8);
    const auto draw_tile = [&](unsigned tile) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        for (unsigned row = tile / columns * 8, end = std::min(row + 8, height); row < end; ++row) {
            alignas(32) int valid[8];
            RTCRayHit8 rays{};
            for (unsigned i = 0; i < 8; ++i) {
                const unsigned column = tile % columns * 8 + i;
                valid[i] = column < width ? -1 : 0;
                const float x = (column + 0.5f - 0.5f * width) * pixel, y = (row + 0.5f - 0.5f * height) * pixel;
                const Vec way = forward + x * right + y * down;
                rays.ray.org_x[i] = eye.x, rays.ray.org_y[i] = eye.y, rays.ray.org_z[i] = eye.z;
                rays.ray.dir_x[i] = way.x, rays.ray.dir_y[i] = way.y, rays.ray.dir_z[i] = way.z;
                rays.ray.tnear[i] = 0, rays.ray.tfar[i] = INFINITY, rays.ray.mask[i] = ~0u;
                rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            }
            rtcIntersect8(valid, scene, &context, &rays);
            for (unsigned i = 0; i < 8; ++i) {
                if (!valid[i]) continue;
                unsigned char& gray = picture[size_t(row) * width + tile % columns * 8 + i];
                if (rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) { gray = 255; continue; }
                const Vec normal = unit({rays.hit.Ng_x[i], rays.hit.Ng_y[i], rays.hit.Ng_z[i]});
                const Vec way = unit({rays.ray.dir_x[i], rays.ray.dir_y[i], rays.ray.dir_z[i]});
                gray = static_cast<unsigned char>(230 * std::fabs(dot(normal, way)));
            }
        }
    };
    std::vector<double> times;
    for (int frame = -2, frames = std::max(1, std::atoi(words[3])); frame < frames; ++frame) {
        const double start = seconds();
        std::atomic<unsigned> next{0};
        std::vector<std::thread> threads;
        for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
            threads.emplace_back([&] { for (unsigned tile; (tile = next++) < tiles;) draw_tile(tile); });
        for (auto& thread : threads) thread.join();
        if (frame >= 0) times.push_back(seconds() - start);
    }
    std::sort(times.begin(), times.end());
    const size_t covered = picture.size() - std::count(picture.begin(), picture.end(), 255);
    std::printf("%zu discs: built in %.2f s, frame %.1f ms (%.1f to %.1f), %zu pixels covered\n", splats, built,
        1e3 * times[times.size() / 2], 1e3 * times.front(), 1e3 * times.back(), covered);
    if (count > 7) {
        std::ofstream out(words[7], std::ios::binary);
        out << "P5\n" << width << ' ' << height << "\n255\n";
        out.write(reinterpret_cast<const char*>(picture.data()), picture.size());
    }
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}
