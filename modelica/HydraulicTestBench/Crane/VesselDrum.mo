within HydraulicTestBench.Crane;
model VesselDrum "Wire drum on a vessel that heaves"
  extends Icons.Component;
  parameter Types.Length r_d(min=1e-3) "Radius of the drum";
  Interfaces.RealInput z_v_t(unit="m/s") "Velocity of the vessel, upwards"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  Interfaces.Flange_a shaft "Shaft"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Interfaces.TranslationFlange_b wire "Upper end of the wire"
    annotation(Placement(transformation(extent={{-10, -110}, {10, -90}})));
  Types.Length z_v "Heave of the vessel, 0 at the start";
initial equation
  z_v = 0;
equation
  der(wire.s) = z_v_t + r_d*der(shaft.phi);
  wire.s = z_v + r_d*shaft.phi;
  shaft.tau = -r_d*wire.f;
  annotation(Documentation(info="<html>
<p>s = z<sub>v</sub> + r &theta;: positive rotation hoists. The work that the heaving vessel does on the wire is
taken from
the vessel. The position of the wire's end is a state, so that what joins it, such as a <code>Wire</code>, has its
velocity without any equation being differentiated.</p>
<p><b>Source:</b> thesis Eq. 5.49.</p>
<p><b>Valid:</b> a vessel that the payload does not move.</p>
<p><b>Leaves out:</b> roll and pitch, layers of wire, inertia of the drum (add an <code>Inertia</code>).</p>
</html>"));
end VesselDrum;
