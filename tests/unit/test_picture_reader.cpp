// Pictures that are read ahead are those that would be read later, and mistakes are left to later.
#include "check.h"
#include "scene/texture_files.h"
#include "temporary_folder.h"

#include <chrono>
#include <thread>

namespace test_picture_reader {

namespace {

// A scene with a texture for each file; materials use them in the opposite order.
SceneDesc sceneOf(const std::vector<std::string>& files) {
    SceneDesc desc;
    for (const std::string& file : files) {
        TextureDesc texture;
        texture.name = "of " + file;
        texture.file = file;
        desc.textures.push_back(texture);
        MaterialDesc material;
        material.diffuseTexture = static_cast<Handle>(files.size() - desc.textures.size());
        desc.materials.push_back(material);
    }
    return desc;
}

} // namespace

TEST(picture_reader_gives_what_the_files_hold_once) {
    const TemporaryFolder folder("reader-ahead");
    std::vector<std::string> files;
    for (int i = 0; i < 20; ++i) {
        files.push_back("p" + std::to_string(i) + ".ppm");
        folder.write(files.back(), "P2 2 1 255 " + std::to_string(i) + " 7\n");
    }
    const SceneDesc desc = sceneOf(files);
    const std::vector<std::size_t> used = usedTextures(desc, true);
    CHECK_EQUAL(used.size(), files.size());
    CHECK_EQUAL(used.front(), files.size() - 1);
    int ahead = 0;
    // The threads may come too late for a round, but not for all.
    int round = 0;
    for (; round < check::scaled(20) || (ahead == 0 && round < 10000); ++round) {
        PictureReader reader("", 5);
        reader.begin(desc, used, folder / "scene.txt");
        reader.begin(desc, used, folder / "scene.txt"); // not again
        if (round % 3 == 0) reader.beginNoMore();
        if (round % 3 == 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        for (std::size_t i = 0; i < files.size(); ++i) {
            const auto image = reader.take(desc.textures[i]);
            if (!image) continue; // not begun: left to the caller
            ++ahead;
            CHECK_INFO(image->bytes == std::vector<std::uint8_t>({static_cast<std::uint8_t>(i), 7}),
                       "round " << round << " picture " << i);
            CHECK_INFO(!reader.take(desc.textures[i]), "round " << round << " picture " << i);
        }
    }
    CHECK_INFO(ahead > 0, round << " rounds");
}

TEST(picture_reader_leaves_mistakes_and_what_is_not_used) {
    const TemporaryFolder folder("reader-mistakes");
    folder.write("broken.png", "no picture");
    folder.write("unused.ppm", "P2 1 1 255 3\n");
    SceneDesc desc = sceneOf({"missing.ppm", "broken.png", std::string("nul\0.ppm", 8)});
    desc.textures.push_back(sceneOf({"unused.ppm"}).textures[0]);
    desc.materials[0].bumpMap = 77; // of no texture, as before validation
    desc.world.environment = 78;
    const std::vector<std::size_t> used = usedTextures(desc, true);
    CHECK_EQUAL(used.size(), std::size_t{3});
    PictureReader reader("", 4);
    reader.begin(desc, used, folder / "scene.txt");
    for (const TextureDesc& texture : desc.textures)
        CHECK_INFO(!reader.take(texture), texture.name);
    const SourceFile source{folder / "scene.txt", "text"};
    CHECK(check::thrown([&] { loadPicture(desc.textures[1], source, ""); }).find("can't be read") !=
          std::string::npos);
}

TEST(picture_reader_has_no_thread_to_spare_of_two) {
    const TemporaryFolder folder("reader-spare");
    folder.write("a.ppm", "P2 1 1 255 3\n");
    const SceneDesc desc = sceneOf({"a.ppm"});
    PictureReader reader("", 2);
    reader.begin(desc, usedTextures(desc, true), folder / "scene.txt");
    CHECK(!reader.take(desc.textures[0]));
}

} // namespace test_picture_reader
