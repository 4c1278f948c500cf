within HydraulicTestBench.Mechanics;
model Mass "Mass that moves up and down, with its weight"
  extends Icons.Component;
  parameter Types.Mass m(min=1e-6) "Mass";
  parameter Types.Acceleration g = 9.81 "Gravity, against positive s; 0 for a mass on a level";
  parameter Types.Length s_start = 0 "Position at the start";
  Interfaces.TranslationFlange_a flange_a "One side"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.TranslationFlange_b flange_b "The other side"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  Types.Length s(start=s_start, fixed=true, stateSelect=StateSelect.prefer) "Position, upwards";
  Types.Velocity v(start=0, fixed=true, stateSelect=StateSelect.prefer) "Velocity";
  Types.Acceleration a "Acceleration";
equation
  flange_a.s = s;
  flange_b.s = s;
  der(s) = v;
  der(v) = a;
  m*a = flange_a.f + flange_b.f - m*g;
  annotation(Documentation(info="<html>
<p>m a = f<sub>a</sub> + f<sub>b</sub> - m g.</p>
<p>Its start is <code>s_start</code> and <code>v(start=...)</code>. Rigidly at a second mass that would be one start too
many: <code>s(fixed=false), v(fixed=false)</code> on one of the two takes the start of the other.</p>
<p><b>Source:</b> Newton's law; thesis Section 5.7, where the weight of the payload is missing in Eq. 5.44.</p>
<p><b>Valid:</b> a rigid body.</p>
</html>"));
end Mass;
