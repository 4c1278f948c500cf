package Rail
  partial model PartialForce "A force on the slide"
    input Real x(unit="m");
    input Real v(unit="m/s");
    output Real f(unit="N");
  end PartialForce;
  model NoForce "Nothing"
    extends PartialForce;
  equation
    f = 0;
  end NoForce;
  model Slide "A slide on a spring"
    parameter Real m(unit="kg", min=0.5, max=5, nominal=2) = 2;
    parameter Real d(unit="N.s/m", min=0, max=50, nominal=5) = 5;
    parameter Real k(unit="N/m", min=50, max=1000, nominal=300) = 300;
    input Real F(unit="N", start=0);
    output Real x(unit="m", start=0, fixed=true);
    Real v(unit="m/s", start=0, fixed=true);
    replaceable NoForce rail constrainedby PartialForce;
  equation
    rail.x = x;
    rail.v = v;
    der(x) = v;
    m*der(v) = F - d*v - k*x + rail.f;
  end Slide;
end Rail;
