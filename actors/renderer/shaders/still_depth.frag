// How far away what stands still is, where something may move.

uniform sampler2D depths;

void main() {
    gl_FragDepth = texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r;
}
