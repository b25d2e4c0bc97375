#include "editor/cli/command.h"

int main(int argc, char** argv) { return focalstage::run_focalstage(argc, argv); }
