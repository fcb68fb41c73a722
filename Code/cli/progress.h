// Progress: how far a render is, for people (a bar on a terminal) and for logs (a line per 10 %).
// Where it is written and what time it is come from outside, so that tests can watch it.
#pragma once

#include <functional>
#include <string>
#include <string_view>

class Progress {
public:
    enum class Style { None, Plain, Bar };
    using Write = std::function<void(std::string_view)>;
    using Seconds = std::function<double()>; // since any fixed moment

    // `columns`: width of the terminal, used by Bar. Nothing is written before `quietSeconds` have
    // passed, so that a render that is over by then says nothing.
    Progress(Style style, int columns, Write write, Seconds now, double quietSeconds = 0);
    // Takes an unfinished bar off the screen, so that a message can follow.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // `part` is from 0 to 1 and never falls. Not to be called from two threads at once.
    void update(double part);

private:
    void drawBar(double part, double elapsed);
    void printSteps(double part, double elapsed);

    Style style_;
    int columns_;
    Write write_;
    Seconds now_;
    double start_, quietSeconds_;
    double lastDrawn_ = -1; // seconds since start_; negative: nothing is drawn yet
    int nextStep_ = 1;      // the next 10 % that Plain has to print
    bool onScreen_ = false;
};

// "0:07", "12:34", "1:02:03"
std::string clockText(double seconds);
// "0.03 s", "12.5 s", and from a minute on as clockText()
std::string durationText(double seconds);
