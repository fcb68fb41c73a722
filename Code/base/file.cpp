#include "base/file_text.h"

#include "base/error.h"
#include "base/for_each.h"
#include "base/platform/platform.h"
#include "base/text.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>

namespace {

namespace fs = std::filesystem;

struct CloseFile {
    void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// A fixed buffer and a lock-free pointer: all that a signal handler may look at.
std::array<char, 4096> pendingName;
std::atomic<const char*> pending = nullptr;
static_assert(std::atomic<const char*>::is_always_lock_free);
std::mutex oneWriteAtATime;

// Announces a temporary file before it is made, and removes it at the end unless it was renamed.
class PendingFile {
public:
    explicit PendingFile(const std::string& name) : name_(name) {
        if (name.size() >= pendingName.size()) return; // longer than a path may be: open fails
        std::copy(name.begin(), name.end(), pendingName.begin());
        pendingName[name.size()] = '\0';
        pending = pendingName.data();
    }
    ~PendingFile() {
        if (isThere_) static_cast<void>(std::remove(name_.c_str()));
        pending = nullptr;
    }
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    // Also where there is a file of that name. Says what was in the way.
    std::error_code renameTo(const std::string& target) {
        std::error_code failed;
        fs::rename(name_, target, failed);
        isThere_ = static_cast<bool>(failed);
        return failed;
    }

private:
    std::string name_;
    bool isThere_ = true;
};

[[noreturn]] void failWriting(const std::string& fileName, const std::string& reason) {
    fail(ErrorKind::Output, cat(fileName, ": error: cannot write: ", reason));
}
[[noreturn]] void failWriting(const std::string& fileName, int reason) {
    std::string hint;
    if (reason == ENOENT)
        hint = cat("; the folder '", fs::path(fileName).parent_path().string(), "' must exist");
    failWriting(fileName, std::strerror(reason) + hint);
}

// Writes and closes; nothing is on the disk for sure before fclose() succeeds. Small pieces are
// gathered: the system takes many pages at once in a third of the time. Large ones it takes from
// where they are: to copy them costs more, in memory that nothing has touched before.
void writeBytes(const std::string& path, const std::string& fileName, ByteSource produce) {
    constexpr std::size_t kGathered = std::size_t{1} << 18;
    const auto buffer = std::make_unique_for_overwrite<char[]>(kGathered);
    File file(std::fopen(path.c_str(), "wb"));
    if (!file) failWriting(fileName, errno);
    static_cast<void>(std::setvbuf(file.get(), buffer.get(), _IOFBF, kGathered));
    const auto write = [&](std::span<const std::uint8_t> bytes) {
        if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
            failWriting(fileName, errno);
    };
    produce(write);
    if (std::fclose(file.release()) != 0) failWriting(fileName, errno);
}

// The bytes in front of the first that could not be read; the reader of a stream goes on there.
std::size_t readParts(std::FILE* file, std::span<char> to, int threads) {
    constexpr std::size_t kPart = std::size_t{1} << 19;
    std::vector<std::size_t> got((to.size() + kPart - 1) / kPart);
    forEachPart(threads, to.size(), kPart, [&](std::size_t first, std::size_t last) {
        got[first / kPart] = readAt(file, first, to.subspan(first, last - first));
    });
    std::size_t used = 0;
    for (std::size_t part = 0; part < got.size() && used == part * kPart; ++part) used += got[part];
    return used;
}

template <class Bytes> Bytes readWhole(const std::string& fileName, int threads) {
    const auto failReading = [&](const std::string& reason) {
        fail(ErrorKind::Input, cat(fileName, ": error: cannot read: ", reason));
    };
    std::error_code status;
    const fs::file_status kind = fs::status(fileName, status);
    if (fs::is_directory(kind)) failReading("it is a folder; name a file in it");
    // /dev/zero has no end.
    if (fs::is_character_file(kind) || fs::is_block_file(kind))
        failReading("it is a device; name a file");
    const File file(std::fopen(fileName.c_str(), "rb"));
    if (!file) failReading(std::strerror(errno));
    Bytes bytes;
    std::size_t used = 0;
    const std::uintmax_t promised = fs::is_regular_file(kind) ? fs::file_size(fileName, status) : 0;
    constexpr std::uintmax_t kFirstPart = 1 << 16;
    // One byte more than promised: the end is seen without another allocation.
    const auto size =
        static_cast<std::size_t>(status ? kFirstPart : std::max(promised + 1, kFirstPart));
    bytes.resize(size);
    if (!status && promised > kFirstPart && threads != 1) {
        used = readParts(file.get(), {reinterpret_cast<char*>(bytes.data()), size - 1}, threads);
        if (std::fseek(file.get(), static_cast<long>(used), SEEK_SET) != 0)
            failReading(std::strerror(errno));
    }
    while (true) {
        const std::size_t read =
            std::fread(bytes.data() + used, 1, bytes.size() - used, file.get());
        used += read;
        if (used < bytes.size()) break;
        bytes.resize(2 * bytes.size());
    }
    if (std::ferror(file.get())) failReading(std::strerror(errno));
    bytes.resize(used);
    return bytes;
}

} // namespace

std::vector<std::uint8_t> readWholeFile(const std::string& fileName) {
    return readWhole<std::vector<std::uint8_t>>(fileName, 1);
}

FileText readWholeText(const std::string& fileName, int threads) {
    return readWhole<FileText>(fileName, threads);
}

void writeFileAtomically(const std::string& fileName, std::span<const std::uint8_t> bytes) {
    writeFileAtomically(fileName, [&](ByteSink write) { write(bytes); });
}

void writeFileAtomically(const std::string& fileName, ByteSource produce) {
    const std::scoped_lock lock(oneWriteAtATime);
    std::error_code status;
    std::string target = fileName;
    // To rename would replace a symbolic link instead of what it points to.
    if (fs::is_symlink(fs::symlink_status(fileName, status))) {
        const fs::path real = fs::weakly_canonical(fileName, status);
        if (!status) target = real.string();
    }
    const fs::file_status kind = fs::status(target, status);
    if (fs::is_directory(kind)) failWriting(fileName, EISDIR);
    if (fs::exists(kind) && !fs::is_regular_file(kind))
        return writeBytes(target, fileName, produce);
    // To rename takes rights in the folder only; a write-protected file stays protected.
    if (fs::exists(kind))
        if (const std::string why = whyNotWritable(target); !why.empty())
            failWriting(fileName, why);

    const std::string temporary = cat(target, ".", processNumber(), ".tmp");
    PendingFile pendingFile(temporary);
    writeBytes(temporary, fileName, produce);
    if (const std::error_code failed = pendingFile.renameTo(target))
        failWriting(fileName, failed.value());
}

const char* pendingTemporaryFile() { return pending; }
