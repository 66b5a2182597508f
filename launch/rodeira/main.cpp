#include "launch/rodeira/commands.hpp"

int main(int argc, char** argv) { return rodeira::cli::Main(argc, argv); }
