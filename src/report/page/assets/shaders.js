// Programs of the graphics card. A block's pose and colour are three texels: rotation, place with scale, colour.
const POSED = `#version 300 es
precision highp float;
uniform mat4 matrix;
uniform highp sampler2D blocks;
vec4 texel(uint body, int k){int w=textureSize(blocks,0).x/3;return texelFetch(blocks,ivec2(int(body)%w*3+k,int(body)/w),0);}
vec3 rotated(vec4 q,vec3 v){if(q.w>1.5)return v+cross(q.xyz,v);vec3 t=2.0*cross(q.xyz,v);return v+q.w*t+cross(q.xyz,t);}
`;
const LIGHT = `#version 300 es
precision highp float;
uniform vec3 upward,sun,eye;
vec3 lit(vec3 colour,vec3 n){
float sky=0.5+0.5*dot(n,upward);float key=max(dot(n,sun),0.0);float fill=max(dot(n,eye),0.0);
return colour*(0.50+0.22*sky+0.30*key+0.12*fill);}
`;
const SHADERS = {
  solid: [`${POSED}
layout(location=0) in vec3 p;layout(location=1) in vec3 n;layout(location=2) in uint body;
out vec3 normal;out vec4 colour;out vec3 own;uniform float glass;
void main(){vec4 q=texel(body,0);vec4 c=texel(body,1);colour=texel(body,2);own=p;normal=rotated(q,n);
bool there=glass>0.5?colour.a>0.0&&colour.a<1.0:colour.a>=1.0;
gl_Position=there?matrix*vec4(c.xyz+rotated(q,p*c.w),1.0):vec4(2.0,2.0,2.0,1.0);}`,
  `${LIGHT}
in vec3 normal;in vec4 colour;in vec3 own;uniform float ball;out vec4 ink;
void main(){vec3 c=lit(colour.rgb,normalize(normal));if(ball>0.5&&abs(own.z)<0.045)c*=0.8;ink=vec4(c*colour.a,colour.a);}`],
  edge: [`${POSED}
layout(location=0) in vec3 p;layout(location=2) in uint body;
void main(){vec4 q=texel(body,0);vec4 c=texel(body,1);gl_Position=texel(body,2).a>0.0?matrix*vec4(c.xyz+rotated(q,p*c.w),1.0):vec4(2.0,2.0,2.0,1.0);}`,
  `#version 300 es
precision highp float;uniform vec4 tint;out vec4 ink;void main(){ink=tint;}`],
  // Profiles turned about the way from one end to the other: x in lengths, y and z in radii, along and across.
  rod: [`#version 300 es
precision highp float;
uniform mat4 matrix;uniform float shrink;
layout(location=0) in vec3 profile;layout(location=1) in vec2 around;layout(location=2) in vec2 slope;
layout(location=3) in vec3 a;layout(location=4) in vec3 b;layout(location=5) in float r;layout(location=6) in vec3 tint;
out vec3 normal;out vec3 colour;
void main(){vec3 d=b-a;float l=max(length(d),1e-9);vec3 w=d/l;vec3 s=normalize(cross(w,abs(w.z)<0.9?vec3(0,0,1):vec3(1,0,0)));vec3 t=cross(w,s);
vec3 side=s*around.x+t*around.y;float R=shrink>0.0?min(r,l*shrink):r;
normal=side*slope.y+w*slope.x;colour=tint;gl_Position=matrix*vec4(a+w*(profile.x*l+profile.y*R)+side*(profile.z*R),1.0);}`,
  `${LIGHT}
in vec3 normal;in vec3 colour;out vec4 ink;
void main(){ink=vec4(mix(colour,lit(colour,normalize(normal)),0.5),1.0);}`],
  face: [`#version 300 es
precision highp float;uniform mat4 matrix;layout(location=0) in vec3 p;layout(location=1) in vec4 tint;out vec4 colour;void main(){colour=tint;gl_Position=matrix*vec4(p,1.0);}`,
  `#version 300 es
precision highp float;in vec4 colour;out vec4 ink;void main(){ink=vec4(colour.rgb*colour.a,colour.a);}`],
};
