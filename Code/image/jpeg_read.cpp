// Reads JPEG: the segments of a file one after the other (ITU-T T.81, annex B), up to the pixels.
#include "base/text.h"
#include "image/bits.h"
#include "image/formats.h"
#include "image/jpeg_parts.h"

#include <algorithm>
#include <optional>
#include <string_view>

using namespace std::string_view_literals;

namespace {

// These are the last bytes of markers (table B.1).
enum JpegMarker : unsigned {
    kJpegTemporary = 0x01,
    kJpegBaseline = 0xC0,
    kJpegExtended = 0xC1,
    kJpegProgressive = 0xC2,
    kJpegHuffmanTables = 0xC4,
    kJpegFirstRestart = 0xD0,
    kJpegLastRestart = 0xD7,
    kJpegStart = 0xD8,
    kJpegEnd = 0xD9,
    kJpegScanStart = 0xDA,
    kJpegQuantisation = 0xDB,
    kJpegRestartInterval = 0xDD,
    kJpegApplication = 0xE0,      // APP0: JFIF uses it
    kJpegApplicationAdobe = 0xEE, // APP14
};

// Says which kind of picture a marker belongs to that this reader does not read; "" for others.
std::string_view jpegUnknownKind(unsigned marker) {
    switch (marker) {
    case 0xC3: return "lossless";
    case 0xC5:
    case 0xC6:
    case 0xC7:
    case 0xDE: // DHP
    case 0xDF: // EXP
        return "hierarchical";
    case 0xC9:
    case 0xCA: return "arithmetic-coded";
    case 0xCB: return "lossless and arithmetic-coded";
    case 0xCC: return "arithmetic-coded"; // DAC
    case 0xCD:
    case 0xCE:
    case 0xCF: return "hierarchical and arithmetic-coded";
    case 0xC8: return "of a reserved kind (JPG)";
    default: return "";
    }
}

class JpegReader {
public:
    JpegReader(Bytes file, const std::string& name) : file_(file), name_(name) {}

    StoredImage read() {
        if (file_.size() < 2 || file_[0] != 0xFF || file_[1] != kJpegStart)
            failPicture(name_,
                        "the file does not begin with the bytes FF D8; each JPEG picture does");
        std::size_t at = 2;
        while (!isComplete()) {
            const std::size_t marker = nextJpegMarker(file_, at);
            if (marker == file_.size())
                failPicture(name_, "the file ends before the picture does (the marker EOI); it is "
                                   "cut off or damaged");
            const unsigned kind = file_[marker];
            at = marker + 1;
            if (kind == kJpegEnd) break;
            if (kind == kJpegTemporary || (kind >= kJpegFirstRestart && kind <= kJpegLastRestart))
                continue; // these markers have no segment
            const Bytes segment = segmentAt(at);
            at += 2 + segment.size();
            if (kind == kJpegScanStart)
                at = takeScan(segment, at);
            else
                take(kind, segment, file_.size() - at);
        }
        return finished();
    }

private:
    // Returns the bytes of a segment without its length, which starts at `at`.
    Bytes segmentAt(std::size_t at) const {
        const std::size_t left = file_.size() - at;
        const std::size_t length = left < 2 ? left + 1 : loadBig<std::uint16_t>(&file_[at]);
        if (length > left)
            failPicture(name_,
                        "the file ends in the middle of a segment; it is cut off or damaged");
        if (length < 2)
            failPicture(
                name_, cat("the segment at byte ", at, " has the length ", length, "; at least 2"));
        return file_.subspan(at + 2, length - 2);
    }

    void take(unsigned kind, Bytes segment, std::size_t left) {
        const std::string_view text(reinterpret_cast<const char*>(segment.data()), segment.size());
        if (const std::string_view unknown = jpegUnknownKind(kind); !unknown.empty())
            failPicture(name_, cat("the picture is ", unknown,
                                   "; it must be baseline, extended or progressive, with Huffman "
                                   "codes"));
        switch (kind) {
        case kJpegStart:
            failPicture(name_, "a second picture starts within the first one; there must be one");
        case kJpegBaseline:
        case kJpegExtended:
        case kJpegProgressive:
            if (frame_) failPicture(name_, "there are two frame headers; there must be one");
            frame_ = readJpegFrame(segment, kind == kJpegProgressive, left, name_);
            break;
        case kJpegHuffmanTables: readJpegHuffman(segment, tables_, name_); break;
        case kJpegQuantisation: readJpegSteps(segment, tables_, name_); break;
        case kJpegRestartInterval:
            if (segment.size() != 2)
                failPicture(name_, cat("the restart interval has ", segment.size(), " bytes; 2"));
            restartInterval_ = loadBig<std::uint16_t>(segment.data());
            break;
        case kJpegApplication: isJfif_ = isJfif_ || text.starts_with("JFIF\0"sv); break;
        case kJpegApplicationAdobe: // byte 11 is the transform
            if (text.starts_with("Adobe") && segment.size() >= 12) adobeTransform_ = segment[11];
            break;
        default: break; // comments and the data of applications are skipped
        }
    }

    // Reads a scan header (B.2.3) and the scan; returns where it ends.
    std::size_t takeScan(Bytes segment, std::size_t at) {
        if (!frame_)
            failPicture(name_, "a scan comes before the frame header; it must come after it");
        const std::size_t count = segment.empty() ? 0 : segment[0];
        if (count < 1 || count > frame_->components.size() || segment.size() != 4 + 2 * count)
            failPicture(name_,
                        cat("a scan header has ", segment.size(), " bytes for ", count,
                            " components; 4, and 2 for each of 1 to ", frame_->components.size()));
        if (++scans_ > kMostScans)
            failPicture(name_, cat("the picture has more than ", kMostScans,
                                   " scans; at most so "
                                   "many are read"));
        const Bytes bands = segment.subspan(1 + 2 * count);
        JpegScan scan;
        scan.restartInterval = restartInterval_;
        if (frame_->isProgressive) {
            scan.spectralStart = bands[0];
            scan.spectralEnd = bands[1];
            scan.highBit = bands[2] >> 4;
            scan.lowBit = bands[2] & 15;
            checkBand(scan, count);
        }
        for (std::size_t i = 0; i < count; ++i)
            scan.parts.push_back(partOf(scan, segment[1 + 2 * i], segment[2 + 2 * i]));
        for (const JpegScan::Part& part : scan.parts) startComponent(scan, *part.component);
        return decodeJpegScan(scan, *frame_, file_, at, name_);
    }

    // Fails unless a progressive scan may have these coefficients and bits (G.1.1.1).
    void checkBand(const JpegScan& scan, std::size_t count) const {
        const bool isDc = scan.spectralStart == 0;
        if (isDc ? scan.spectralEnd != 0
                 : scan.spectralEnd < scan.spectralStart ||
                       scan.spectralEnd >= kJpegZigzag.size() || count != 1)
            failPicture(name_, cat("a scan of ", count, " components has the coefficients ",
                                   scan.spectralStart, " to ", scan.spectralEnd,
                                   "; it must have 0 alone, or some of 1 to 63 of one component"));
        constexpr int kMostBit = 13;
        if (scan.lowBit > kMostBit || (scan.highBit != 0 && scan.highBit != scan.lowBit + 1))
            failPicture(name_, cat("a scan comes from the bit ", scan.highBit, " to ", scan.lowBit,
                                   "; from 0 to at most ", kMostBit, ", or to the next lower one"));
    }

    JpegScan::Part partOf(const JpegScan& scan, unsigned id, unsigned tables) {
        const auto component =
            std::find_if(frame_->components.begin(), frame_->components.end(),
                         [id](const JpegComponent& other) { return other.id == id; });
        if (component == frame_->components.end())
            failPicture(name_, cat("a scan has the component ", id,
                                   ", which is not in the frame "
                                   "header; it must be one of these"));
        for (const JpegScan::Part& other : scan.parts)
            if (other.component == &*component)
                failPicture(name_, cat("a scan has the component ", id, " twice; once"));
        const bool isSequential = !frame_->isProgressive;
        const bool isDc = scan.spectralStart == 0;
        const bool needsDc = isDc && scan.highBit == 0, needsAc = isSequential || !isDc;
        const unsigned dc = tables >> 4, ac = tables & 15;
        const auto isMissing = [](const auto& known, unsigned number) {
            return number >= known.size() || !known[number].isDefined();
        };
        if ((needsDc && isMissing(tables_.dc, dc)) || (needsAc && isMissing(tables_.ac, ac)))
            failPicture(name_, cat("a scan has the Huffman tables ", dc, " (DC) and ", ac,
                                   " (AC), which are not in the file before it; they must be"));
        return {&*component, needsDc ? &tables_.dc[dc] : nullptr,
                needsAc ? &tables_.ac[ac] : nullptr};
    }

    // Takes the memory for a component before its first scan, and notes which bits each scan adds:
    // no bit may come twice, so that the work does not grow with the number of scans alone.
    void startComponent(const JpegScan& scan, JpegComponent& component) const {
        if (!component.hasScan) {
            const JpegSteps& steps = tables_.steps[component.table];
            if (!steps.isDefined)
                failPicture(name_, cat("the component ", component.id,
                                       " has the quantisation table ", component.table,
                                       ", which is not in the file before it; it must be"));
            component.steps = steps;
            if (frame_->isProgressive) {
                component.coefficients.resize(component.storedColumns * component.storedRows);
                component.ends.resize(component.coefficients.size());
            } else {
                component.samples.resize(kJpegSide * component.storedRows * component.stride());
            }
        } else if (!frame_->isProgressive) {
            failPicture(name_, cat("the component ", component.id, " has two scans; one"));
        }
        component.hasScan = true;
        if (!frame_->isProgressive) return;
        if (scan.spectralStart > 0 && component.lowestBit[0] == JpegComponent::kNoBit)
            failPicture(name_, cat("the first scan of the component ", component.id,
                                   " has not the coefficient 0; it must"));
        const int before = scan.highBit == 0 ? JpegComponent::kNoBit : scan.highBit;
        for (unsigned k = scan.spectralStart; k <= scan.spectralEnd; ++k) {
            if (component.lowestBit[k] != before)
                failPicture(name_, cat("a scan repeats or leaves out bits of the coefficient ", k,
                                       " of the component ", component.id,
                                       "; each bit must come once, the highest first"));
            component.lowestBit[k] = scan.lowBit;
        }
    }

    // A sequential picture ends with the only scan of its last component, whatever comes then.
    bool isComplete() const { return frame_ && !frame_->isProgressive && allHaveScans(); }
    bool allHaveScans() const {
        return std::all_of(frame_->components.begin(), frame_->components.end(),
                           [](const JpegComponent& component) { return component.hasScan; });
    }

    StoredImage finished() {
        if (!frame_)
            failPicture(name_, "the file ends before the frame header; it is cut off or damaged");
        if (!allHaveScans())
            failPicture(
                name_,
                "the file ends before all components have had a scan; it is cut off or damaged");
        if (frame_->isProgressive)
            for (JpegComponent& component : frame_->components) transformJpegComponent(component);
        return jpegPicture(*frame_, isYcc());
    }
    // JFIF allows nothing but YCbCr, and goes before an Adobe segment in common decoders.
    bool isYcc() const {
        if (isJfif_) return true;
        if (adobeTransform_) return *adobeTransform_ != 0;
        constexpr std::array<unsigned, 3> kRgb{'R', 'G', 'B'};
        return !std::equal(kRgb.begin(), kRgb.end(), frame_->components.begin(),
                           frame_->components.end(),
                           [](unsigned id, const JpegComponent& c) { return id == c.id; });
    }

    static constexpr int kMostScans = 200; // encoders make some ten

    Bytes file_;
    const std::string& name_;
    JpegTables tables_;
    std::optional<JpegFrame> frame_;
    std::size_t restartInterval_ = 0;
    bool isJfif_ = false;
    std::optional<unsigned> adobeTransform_;
    int scans_ = 0;
};

} // namespace

StoredImage decodeJpeg(Bytes file, const std::string& name) {
    return JpegReader(file, name).read();
}
