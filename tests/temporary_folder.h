// An empty folder for one test, removed at its end.
#pragma once

#include "base/platform/platform.h"
#include "base/text.h"

#include <filesystem>
#include <fstream>
#include <string>

class TemporaryFolder {
public:
    explicit TemporaryFolder(const char* name)
        : path_(std::filesystem::temp_directory_path() /
                cat("raytracer-", name, "-", processNumber())) {
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    // Returns the file's path.
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path_ / name, std::ios::binary) << text;
        return *this / name;
    }
    std::ptrdiff_t files() const {
        using Walk = std::filesystem::directory_iterator;
        return std::distance(Walk(path_), Walk());
    }

private:
    std::filesystem::path path_;
};
