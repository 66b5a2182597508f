#include "launch/rodeira/commands.hpp"

int main(int argc, char** argv) { return rodeira::front::Main(argc, argv); }
