within HydraulicTestBench.Pump;
model BlackBoxPlate "Swash plate as a transfer function of five poles, thesis Eq. 4.1"
  extends Interfaces.PartialSwashPlate;
  parameter Real b_0(final unit="1/s5", nominal=1e10) = 62091e6 "Numerator";
  parameter Real a_0(final unit="1/s5", nominal=1e10) = 60185e6 "Denominator, power 0";
  parameter Real a_1(final unit="1/s4", nominal=1e9) = 1429e6 "Denominator, power 1";
  parameter Real a_2(final unit="1/s3", nominal=1e7) = 11612e3 "Denominator, power 2";
  parameter Real a_3(final unit="1/s2", nominal=1e5) = 88408 "Denominator, power 3";
  parameter Real a_4(final unit="1/s", nominal=1e2) = 191 "Denominator, power 4";
  constant Types.AngularVelocity omega_0 = 100 "Scale of the states";
  Types.Percent z[5](each start=0, each fixed=true) "Angle and its derivatives, each over omega_0";
equation
  for i in 1:4 loop
    der(z[i]) = omega_0*z[i + 1];
  end for;
  der(z[5]) = (b_0*alphaCMD - a_0*z[1])/omega_0^4 - a_1*z[2]/omega_0^3 - a_2*z[3]/omega_0^2 - a_3*z[4]/omega_0
    - a_4*z[5];
  alphaPercent = z[1];
  alpha = z[1]/100*alphaMAX;
  alpha_t = omega_0*z[2]/100*alphaMAX;
  annotation(Documentation(info="<html>
<p>G<sub>est</sub>(s) = b<sub>0</sub>/(s<sup>5</sup> + a<sub>4</sub>s<sup>4</sup> + ... + a<sub>0</sub>), by default
that
of 25 percent offset and 5 percent amplitude.</p>
<p><b>Source:</b> thesis Eq. 4.1, 5.18, Table 4.1 (25/5, the one Section 5.3 takes).</p>
<p><b>Valid:</b> the test it was fitted to. At rest its gain is b<sub>0</sub>/a<sub>0</sub> = 1.032.</p>
<p><b>Leaves out:</b> stops, and that the dynamics change with amplitude and offset.</p>
</html>"));
end BlackBoxPlate;
