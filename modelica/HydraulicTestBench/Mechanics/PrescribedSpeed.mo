within HydraulicTestBench.Mechanics;
model PrescribedSpeed "Drive that follows a signal whatever the torque"
  extends Icons.Component;
  Interfaces.RealInput w(unit="rad/s") "Speed"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.Flange_b flange "Shaft"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  Types.Angle phi(start=0, fixed=true, stateSelect=StateSelect.always) "Angle";
  Types.Torque tau "Torque delivered";
equation
  der(phi) = w;
  flange.phi = phi;
  tau = -flange.tau;
  annotation(Documentation(info="<html>
<p>As <code>ConstantSpeed</code>, with the speed from a signal.</p>
<p><b>Source:</b> this library, for joining shafts of two programs.</p>
<p><b>Valid:</b> at parts that give a torque from speed. At an <code>Inertia</code>, written <code>Inertia rotor(J=0.01,
phi(fixed=false), w(fixed=false))</code>, the signal has to be one with a derivative: an expression of time and states,
not an input of the whole model.</p>
</html>"));
end PrescribedSpeed;
