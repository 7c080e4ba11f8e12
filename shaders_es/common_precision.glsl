// Said for every kind: some drivers run anything less in 16 bits, samplers and integers too.
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DShadow;
precision highp usampler2D;
precision highp sampler2DArray;
precision highp isampler2D;
precision highp sampler2DArrayShadow;
