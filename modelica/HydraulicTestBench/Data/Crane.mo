within HydraulicTestBench.Data;
record Crane "Small crane in heave compensation: chosen, not published"
  extends Icons.Record;
  Types.Length r_d = 0.03 "Radius of the drum";
  Types.Mass m_PL = 390 "Mass of the payload";
  Types.Volume V_PL = 0.05 "Volume of the payload";
  Types.Area A_PL = 0.2 "Area of the payload seen from above";
  Real C_d(unit="1") = 1.1 "Drag coefficient of the payload";
  Types.Density rho_s = 1025 "Density of sea water";
  Types.Acceleration g = 9.81 "Gravity";
  Real E_w(unit="Pa") = 1e11 "Elasticity of the wire, with its lay";
  Types.Area A_w = 20e-6 "Metallic area of the wire";
  Types.Length L_w = 50 "Length of the wire";
  Types.MomentOfInertia J_d = 0.05 "Inertia of drum and motor";
  Real c_d(unit="N.m.s/rad") = 0.26 "Rotational damping of drum and motor";
  annotation(Documentation(info="<html>
<p><b>The thesis publishes none of these.</b> They are chosen so that the crane suits the test bench: a block of
steel of
390 kg in water pulls 3.3 kN, which on a drum of 30 mm is 100 N m or 105 bar across a motor of 60 cm3; a vessel that
heaves at 1 m/s asks for 33 rad/s. The wire is one of steel of 6 to 7 mm, its stiffness
E<sub>w</sub>A<sub>w</sub>/L<sub>w</sub>
= 40 kN/m (Eq. 5.47).</p>
<p><b>Source:</b> this library; symbols of thesis Section 5.7.</p>
<p><b>Leaves out:</b> that the water around the payload moves with it (added mass).</p>
</html>"));
end Crane;
