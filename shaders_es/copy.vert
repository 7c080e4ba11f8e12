// One triangle over the whole viewport, from no attributes.
void main()
{
	vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
	gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);
#ifdef HANDS_ON_EDGES
	hand_on_edges();
#endif
}
