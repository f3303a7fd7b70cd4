fn main() {
    aim_codegen::build::rigs("rigs");
}
