// Reads the frame header of a JPEG file (ITU-T T.81, B.2.2), which says how large the picture and
// its planes are.
#include "base/text.h"
#include "image/bits.h"
#include "image/jpeg_parts.h"

#include <algorithm>

namespace {

std::size_t jpegQuotientUp(std::size_t number, std::size_t divisor) {
    return (number + divisor - 1) / divisor;
}

void checkJpegHeader(Bytes segment, const std::string& name) {
    if (segment.size() < 6)
        failPicture(name, cat("the frame header has ", segment.size(), " bytes; at least 6"));
    const unsigned precision = segment[0], count = segment[5];
    if (precision != 8)
        failPicture(name, cat("the picture has ", precision, " bits per sample; it must have 8"));
    if (count == 4)
        failPicture(name, "the picture has four components (CMYK or YCCK); it must be grey, YCbCr "
                          "or RGB, with 1 or 3");
    if (count != 1 && count != 3)
        failPicture(name, cat("the picture has ", count, " components; it must have 1 or 3"));
    if (segment.size() != 6 + std::size_t{3} * count)
        failPicture(name, cat("the frame header has ", segment.size(), " bytes for ", count,
                              " components; ", 6 + 3 * count));
}

JpegComponent jpegComponentOf(Bytes bytes, const std::string& name) {
    JpegComponent component;
    component.id = bytes[0];
    component.horizontal = bytes[1] >> 4;
    component.vertical = bytes[1] & 15;
    component.table = bytes[2];
    if (std::min(component.horizontal, component.vertical) < 1 ||
        std::max(component.horizontal, component.vertical) > 4)
        failPicture(name,
                    cat("the component ", component.id, " has the sampling factors ",
                        component.horizontal, "x", component.vertical, "; each must be 1 to 4"));
    if (component.table >= kJpegTables)
        failPicture(name, cat("the component ", component.id, " has the quantisation table ",
                              component.table, "; 0 to 3"));
    return component;
}

// Computes the size of a plane (A.1.1, A.2.4).
void sizeJpegComponent(JpegComponent& component, const JpegFrame& frame) {
    component.width = jpegQuotientUp(frame.width * component.horizontal, frame.mostHorizontal);
    component.height = jpegQuotientUp(frame.height * component.vertical, frame.mostVertical);
    component.columns = jpegQuotientUp(component.width, kJpegSide);
    component.rows = jpegQuotientUp(component.height, kJpegSide);
    component.storedColumns = frame.mcuColumns * component.horizontal;
    component.storedRows = frame.mcuRows * component.vertical;
}

// A block takes at least two bits, a code for its first coefficient and one for the end; in a
// progressive picture the end of many blocks may be one code.
void checkJpegLength(const JpegFrame& frame, std::size_t left, const std::string& name) {
    std::size_t blocks = 0;
    for (const JpegComponent& component : frame.components)
        blocks += component.columns * component.rows;
    const std::size_t leastBits = frame.isProgressive ? 1 : 2;
    if (blocks * leastBits / 8 > left)
        failPicture(name, cat("the file is too short for ", frame.width, "x", frame.height,
                              " pixels: ", left, " bytes cannot hold ", blocks,
                              " blocks; it is cut off or damaged"));
}

} // namespace

JpegFrame readJpegFrame(Bytes segment, bool isProgressive, std::size_t left,
                        const std::string& name) {
    checkJpegHeader(segment, name);
    JpegFrame frame;
    frame.isProgressive = isProgressive;
    frame.height = loadBig<std::uint16_t>(&segment[1]);
    frame.width = loadBig<std::uint16_t>(&segment[3]);
    if (frame.height == 0)
        failPicture(name,
                    "the frame header says that the height comes later (a DNL marker); it must "
                    "say the height");
    checkSize(static_cast<long long>(frame.width), static_cast<long long>(frame.height), name);
    for (std::size_t at = 6; at < segment.size(); at += 3) {
        const JpegComponent component = jpegComponentOf(segment.subspan(at, 3), name);
        for (const JpegComponent& other : frame.components)
            if (other.id == component.id)
                failPicture(name, cat("two components have the identifier ", component.id,
                                      "; each needs its own"));
        frame.components.push_back(component);
    }
    // A picture of one component has no MCUs of several blocks, whatever its factors (A.2.2).
    if (frame.components.size() == 1)
        frame.components[0].horizontal = frame.components[0].vertical = 1;
    for (const JpegComponent& component : frame.components) {
        frame.mostHorizontal = std::max(frame.mostHorizontal, component.horizontal);
        frame.mostVertical = std::max(frame.mostVertical, component.vertical);
    }
    frame.mcuColumns = jpegQuotientUp(frame.width, kJpegSide * frame.mostHorizontal);
    frame.mcuRows = jpegQuotientUp(frame.height, kJpegSide * frame.mostVertical);
    for (JpegComponent& component : frame.components) {
        sizeJpegComponent(component, frame);
        component.lowestBit.fill(JpegComponent::kNoBit);
    }
    checkJpegLength(frame, left, name);
    return frame;
}
