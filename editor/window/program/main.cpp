#include "editor/window/app/editor_program.h"

int main(int argc, char** argv) { return focalstage::run_editor(argc, argv); }
